#include "hil/emulator/emulator_config.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"

namespace ballbot {
namespace {

FaultOrder readFault(ConfigReader& in) {
  using F = EmulatedFault;
  FaultOrder order;
  order.at_cycle = in.integer("at_cycle", {0, 1e9});
  order.kind = in.choice<F>("kind", {{"emergency", F::kEmergency},
                                     {"unannounced_fault", F::kUnannouncedFault},
                                     {"heartbeat_lost", F::kHeartbeatLost},
                                     {"pdos_lost", F::kPdosLost},
                                     {"pdos_truncated", F::kPdosTruncated},
                                     {"power_loss", F::kPowerLoss},
                                     {"reboot", F::kReboot},
                                     {"nmt_stop", F::kNmtStop},
                                     {"nmt_pre_operational", F::kNmtPreOperational},
                                     {"local_disable", F::kLocalDisable},
                                     {"statusword", F::kStatusword},
                                     {"stuck_encoder", F::kStuckEncoder},
                                     {"position_jump", F::kPositionJump},
                                     {"runaway", F::kRunaway},
                                     {"frozen_bus", F::kFrozenBus},
                                     {"sync_held_back", F::kSyncHeldBack},
                                     {"imu_lost", F::kImuLost},
                                     {"imu_frozen", F::kImuFrozen},
                                     {"tilt", F::kTilt},
                                     {"warning", F::kWarning}});
  order.drive = in.integerOr("drive", 1, {1, 6}) - 1;
  // Without one these would do nothing, and a bench would seem tested.
  const F in_need[] = {F::kEmergency,    F::kUnannouncedFault, F::kStatusword, F::kPositionJump,
                       F::kSyncHeldBack, F::kRunaway,          F::kTilt};
  const bool needs =
      std::find(std::begin(in_need), std::end(in_need), order.kind) != std::end(in_need);
  order.value = needs ? in.number("value") : in.numberOr("value", 0);
  in.finish();
  return order;
}

void readOptions(ConfigReader& in, const char* key, std::vector<int>& options) {
  const ConfigNode* list = in.raw(key);
  if (list == nullptr) return;
  options.clear();
  for (const ConfigNode& item : list->items()) {
    const auto value = parseWhole(item.text());
    if (!value || *value < -128 || *value > 127) {
      throw InputError(toText(item.where()) + ": " + key + " has '" + item.text() +
                       "', must be whole numbers from -128 to 127");
    }
    options.push_back(static_cast<int>(*value));
  }
  if (options.empty()) throw InputError(in.at(key) + " must have one value at least");
}

/// What other vendors do otherwise.
void readDeviations(ConfigReader& in, EmulatedDriveParameters& p) {
  p.name = in.textOr("name", p.name);
  // Those of invented devices, so that no real one can be taken for one of these; from BA20 on of
  // such that do not say that they are emulated.
  p.product_code = in.integerOr("product_code", static_cast<int>(p.product_code), {0xBA10, 0xBA2F});
  p.torque_reference_mNm =
      in.integerOr("torque_reference_mNm", static_cast<int>(p.torque_reference_mNm), {1, 1e6});
  p.velocity_bits = in.integerOr("velocity_bits", p.velocity_bits, {16, 32});
  if (p.velocity_bits != 16 && p.velocity_bits != 32) {
    throw InputError(in.at("velocity_bits") + " must be 16 or 32");
  }
  p.velocity_unit = in.numberOr("velocity_unit_rad_per_s", p.velocity_unit, {1e-9, 10});
  p.motor_encoder = in.booleanOr("motor_encoder", p.motor_encoder);
  readOptions(in, "quick_stop_options", p.quick_stop_options);
  readOptions(in, "fault_reaction_options", p.fault_reaction_options);
  readOptions(in, "abort_connection_options", p.abort_connection_options);
}

void readDriveValues(ConfigReader& in, EmulatedDriveParameters& p) {
  p.rated_torque_mNm =
      in.integerOr("rated_torque_mNm", static_cast<int>(p.rated_torque_mNm), {1, 1e6});
  p.max_torque_per_mille =
      in.integerOr("max_torque_per_mille", static_cast<int>(p.max_torque_per_mille), {1, 32767});
  p.encoder_counts = in.integerOr("encoder_counts", static_cast<int>(p.encoder_counts), {16, 1e8});
  p.motor_encoder_counts =
      in.integerOr("motor_encoder_counts", static_cast<int>(p.motor_encoder_counts), {16, 1e8});
  p.rated_current_mA =
      in.integerOr("rated_current_mA", static_cast<int>(p.rated_current_mA), {1, 1e6});
  p.rated_current_torque_mNm = in.integerOr("rated_current_torque_mNm",
                                            static_cast<int>(p.rated_current_torque_mNm), {1, 1e6});
  p.sign = in.numberOr("sign", p.sign, {-1, 1});
  constexpr std::int64_t kMs = 1'000'000;
  p.sdo_delay_ns =
      kMs * in.integerOr("sdo_delay_ms", static_cast<int>(p.sdo_delay_ns / kMs), {0, 10'000});
  readDeviations(in, p);
  p.offset = kRadPerDeg * in.numberOr("offset_deg", p.offset / kRadPerDeg, {-3600, 3600});
}

void readRig(ConfigReader in, EmulatorConfig& c) {
  c.rig = true;
  if (in.has("elastic")) {
    ConfigReader elastic = in.child("elastic");
    ElasticRigOptions options;
    options.joint = ElasticJointParameters::read(elastic);
    options.noise_seed = static_cast<std::uint64_t>(elastic.integerOr("noise_seed", 1, {0, 1e9}));
    elastic.finish();
    options.output = in.booleanOr("blocked", false) ? StandOutput::kBlocked : StandOutput::kFree;
    c.elastic_rig = options;
    return in.finish();
  }
  c.rig_bandwidth_Hz = in.numberOr("natural_frequency_Hz", c.rig_bandwidth_Hz, {0.1, 150});
  c.rig_damping_ratio = in.numberOr("damping_ratio", c.rig_damping_ratio, {0.05, 2});
  c.rig_delay_ms = in.numberOr("delay_ms", c.rig_delay_ms, {0, 50});
  c.rig_blocked = in.booleanOr("blocked", c.rig_blocked);
  in.finish();
}

}  // namespace

EmulatorConfig readEmulatorConfig(const ConfigNode& tree) {
  EmulatorConfig c;
  ConfigReader top(tree);
  c.cycle = top.durationOr("cycle_us", c.cycle, {200, 100'000});
  c.stepped = top.booleanOr("stepped", false);
  for (int i = 0; i < 6; ++i) c.drives[static_cast<std::size_t>(i)].node = i + 1;
  if (!top.has("emulator")) {
    throw InputError(tree.where().source +
                     ": has no section 'emulator'; `ballbot drives` needs one");
  }
  ConfigReader in = top.child("emulator");
  for (ConfigReader& bus : in.list("buses")) {
    c.links.push_back(bus.text("link"));
    const bool flexible = bus.booleanOr("fd", false);
    if (c.links.size() > 1 && flexible != c.flexible) {
      throw InputError(bus.at("fd") + " must be the same for all buses");
    }
    c.flexible = flexible;
    bus.finish();
  }
  if (c.links.empty() || c.links.size() > 2)
    throw InputError(in.at("buses") + " must be one or two");
  c.bus_count = static_cast<int>(c.links.size());
  const double last_bus = c.bus_count - 1;
  if (in.has("imu")) {
    ConfigReader imu = in.child("imu");
    c.imu_bus = imu.integerOr("bus", 0, {0, last_bus});
    c.imu_node = imu.integerOr("node", c.imu_node, {1, 126});
    c.accel_resolution = imu.numberOr("accel_resolution_m_per_s2", c.accel_resolution, {1e-6, 1});
    c.gyro_resolution = imu.numberOr("gyro_resolution_rad_per_s", c.gyro_resolution, {1e-7, 1});
    imu.finish();
  }
  if (in.has("drive_defaults")) {
    ConfigReader defaults = in.child("drive_defaults");
    readDriveValues(defaults, c.drives[0]);
    defaults.finish();
    c.drives.fill(c.drives[0]);
    for (int i = 0; i < 6; ++i) c.drives[static_cast<std::size_t>(i)].node = i + 1;
  }
  std::vector<ConfigReader> drives = in.list("drives");
  if (!drives.empty() && drives.size() != 6) {
    throw InputError(in.at("drives") + " must have six entries, or none for six equal drives");
  }
  for (std::size_t i = 0; i < drives.size(); ++i) {
    c.drive_bus[i] = drives[i].integerOr("bus", 0, {0, last_bus});
    c.drives[i].node = drives[i].integerOr("node", static_cast<int>(i) + 1, {1, 126});
    readDriveValues(drives[i], c.drives[i]);
    drives[i].finish();
  }
  if (in.has("rig")) readRig(in.child("rig"), c);
  for (ConfigReader& fault : in.list("faults")) c.faults.push_back(readFault(fault));
  in.finish();
  return c;
}

}  // namespace ballbot
