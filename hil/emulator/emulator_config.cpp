#include "hil/emulator/emulator_config.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"
#include "hil/bench_clock.hpp"

namespace ballbot {
namespace {

void describeFault(ConfigVisitor& v, FaultOrder& order) {
  using F = EmulatedFault;
  v.whole(must("at_cycle", "counted in SYNCs"), order.at_cycle, {0, 1e9});
  v.choice(must("kind", "what happens"), order.kind,
           {{"emergency", F::kEmergency},
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
  int drive = order.drive + 1;
  v.integer(may("drive", "to which, 1 to 6"), drive, {1, 6});
  order.drive = drive - 1;
  v.number(may("value", "how much, where the kind needs it"), order.value);
  v.check([&](const ConfigReader& in) {
    // Without one these would do nothing, and a bench would seem tested.
    const F in_need[] = {F::kEmergency,    F::kUnannouncedFault, F::kStatusword, F::kPositionJump,
                         F::kSyncHeldBack, F::kRunaway,          F::kTilt};
    const bool needs =
        std::find(std::begin(in_need), std::end(in_need), order.kind) != std::end(in_need);
    if (needs && !in.has("value")) {
      throw InputError(in.at("value") + " is missing: a fault of this kind needs one");
    }
  });
}

void describeOptions(ConfigVisitor& v, const ConfigKey& key, std::vector<int>& options) {
  v.other(key, "list of whole numbers from -128 to 127", [&](ConfigReader& in) {
    options.clear();
    for (const ConfigNode& item : in.raw(key.name)->items()) {
      const auto value = parseWhole(item.text());
      if (!value || *value < -128 || *value > 127) {
        throw InputError(toText(item.where()) + ": " + key.name + " has '" + item.text() +
                         "', must be whole numbers from -128 to 127");
      }
      options.push_back(static_cast<int>(*value));
    }
    if (options.empty()) throw InputError(in.at(key.name) + " must have one value at least");
  });
}

/// What other vendors do otherwise.
void describeDeviations(ConfigVisitor& v, EmulatedDriveParameters& p) {
  v.text(may("name", "1008"), p.name);
  // Those of invented devices, so that no real one can be taken for one of these; from BA20 on of
  // such that do not say that they are emulated.
  v.whole(may("product_code", "1018:02, of an invented device"), p.product_code, {0xBA10, 0xBA2F});
  v.whole(may("torque_reference_mNm", "torque of 1000 counts, in 2031; 0: it is 6076"),
          p.torque_reference_mNm, {1, 1e6});
  v.integer(may("velocity_bits", "of 606C: 16 or 32"), p.velocity_bits, {16, 32});
  v.check([&](const ConfigReader& in) {
    if (p.velocity_bits != 16 && p.velocity_bits != 32) {
      throw InputError(in.at("velocity_bits") + " must be 16 or 32");
    }
  });
  v.number(may("velocity_unit_rad_per_s", "of 606C and 60B1; 0: counts of 6064 per second"),
           p.velocity_unit, {1e-9, 10});
  v.boolean(may("motor_encoder", "whether there are 60E4, 60E6 and 60EB"), p.motor_encoder);
  describeOptions(v, may("quick_stop_options", "values that 605A takes"), p.quick_stop_options);
  describeOptions(v, may("fault_reaction_options", "values that 605E takes"),
                  p.fault_reaction_options);
  describeOptions(v, may("abort_connection_options", "values that 6007 takes"),
                  p.abort_connection_options);
}

void describeDrive(ConfigVisitor& v, EmulatedDriveParameters& p) {
  v.whole(may("rated_torque_mNm", "6076"), p.rated_torque_mNm, {1, 1e6});
  v.whole(may("max_torque_per_mille", "6072 after power-on"), p.max_torque_per_mille, {1, 32767});
  v.whole(may("encoder_counts", "608F:01, of 6064, per turn of the joint"), p.encoder_counts,
          {16, 1e8});
  v.whole(may("motor_encoder_counts", "60E6:01, of 60E4:01, per turn of the joint"),
          p.motor_encoder_counts, {16, 1e8});
  v.whole(may("rated_current_mA", "6075"), p.rated_current_mA, {1, 1e6});
  v.whole(may("rated_current_torque_mNm", "what that current gives behind the gear"),
          p.rated_current_torque_mNm, {1, 1e6});
  v.number(may("sign", "of all angles and torques against the joint's"), p.sign, {-1, 1});
  constexpr std::int64_t kMs = 1'000'000;
  std::int64_t sdo_delay = p.sdo_delay_ns / kMs;
  v.whole(may("sdo_delay_ms", "of its SDO server's answers"), sdo_delay, {0, 10'000});
  p.sdo_delay_ns = kMs * sdo_delay;
  describeDeviations(v, p);
  v.number(may("offset_deg", "joint angle at which 6064 is zero"), p.offset, {-3600, 3600},
           kRadPerDeg);
}

void describeRig(ConfigVisitor& v, EmulatorConfig& c) {
  c.rig = true;
  v.section(may("elastic", "series elastic actuators instead of an exactly known response"),
            [&](ConfigVisitor& in) {
              ElasticRigOptions options;
              options.joint.describe(in);
              auto seed = static_cast<std::int64_t>(options.noise_seed);
              in.whole(may("noise_seed", "of the noise of all joints"), seed, {0, 1e9});
              options.noise_seed = static_cast<std::uint64_t>(seed);
              c.elastic_rig = options;
            });
  v.number(may("natural_frequency_Hz", "of each joint's response; not with elastic"),
           c.rig_bandwidth_Hz, {0.1, 150});
  v.number(may("damping_ratio", "likewise"), c.rig_damping_ratio, {0.05, 2});
  v.number(may("delay_ms", "likewise"), c.rig_delay_ms, {0, 50});
  v.boolean(may("blocked", "whether outputs are held fast"), c.rig_blocked);
  v.check([&](const ConfigReader& in) {
    if (!c.elastic_rig) return;
    for (const char* key : {"natural_frequency_Hz", "damping_ratio", "delay_ms"}) {
      if (in.has(key)) throw InputError(in.at(key) + " is of a rig that is not elastic");
    }
  });
  if (c.elastic_rig) {
    c.elastic_rig->output = c.rig_blocked ? StandOutput::kBlocked : StandOutput::kFree;
  }
}

}  // namespace

void EmulatorConfig::describeBuses(ConfigVisitor& v) {
  v.list(must("buses", "one, or two"), [this](ConfigVisitor& in) {
    std::string link;
    bool fd = false;
    in.text(must("link", "of the pty; or socketcan:..."), link);
    in.boolean(may("fd", "CAN FD, on all of them"), fd);
    in.check([&](const ConfigReader& at) {
      if (!links.empty() && fd != flexible) {
        throw InputError(at.at("fd") + " must be the same for all buses");
      }
    });
    links.push_back(link);
    flexible = fd;
  });
  v.check([this](const ConfigReader& in) {
    if (links.empty() || links.size() > 2) throw InputError(in.at("buses") + " must be one or two");
  });
  bus_count = static_cast<int>(links.size());
}

void EmulatorConfig::describeDrives(ConfigVisitor& v) {
  const Range buses{0, static_cast<double>(bus_count - 1)};
  v.section(may("drive_defaults", "what drives have in common"),
            [this](ConfigVisitor& in) { describeDrive(in, drives[0]); });
  drives.fill(drives[0]);
  for (std::size_t i = 0; i < drives.size(); ++i) drives[i].node = static_cast<int>(i) + 1;
  std::size_t count = 0;
  v.list(may("drives", "six, or none for six equal ones"), [&](ConfigVisitor& in) {
    EmulatedDriveParameters spare;
    int spare_bus = 0;
    const bool fits = count < drives.size();
    EmulatedDriveParameters& drive = fits ? drives[count] : spare;
    in.integer(may("bus", "on which it is: 0, or 1"), fits ? drive_bus[count] : spare_bus,
               v.depending(buses));
    in.integer(may("node", "its CANopen node; by default 1 to 6"), drive.node, {1, 126});
    describeDrive(in, drive);
    ++count;
  });
  v.check([&](const ConfigReader& in) {
    if (count == 0 || count == drives.size()) return;
    throw InputError(in.at("drives") + " must have six entries, or none for six equal drives");
  });
}

void EmulatorConfig::describe(ConfigVisitor& v) {
  describeBuses(v);
  v.section(may("imu", "where it is, and what it counts in"), [this](ConfigVisitor& in) {
    in.integer(may("bus", "on which it is: 0, or 1"), imu_bus,
               in.depending({0, static_cast<double>(bus_count - 1)}));
    in.integer(may("node", "its CANopen node"), imu_node, {1, 126});
    in.number(may("accel_resolution_m_per_s2", "of one count"), accel_resolution, {1e-6, 1});
    in.number(may("gyro_resolution_rad_per_s", "of one count"), gyro_resolution, {1e-7, 1});
  });
  describeDrives(v);
  v.section(may("rig", "independent joints in the robot's place"),
            [this](ConfigVisitor& in) { describeRig(in, *this); });
  v.list(may("faults", "on demand"), [this](ConfigVisitor& in) {
    FaultOrder order;
    describeFault(in, order);
    faults.push_back(order);
  });
}

EmulatorConfig readEmulatorConfig(const ConfigNode& tree) {
  EmulatorConfig c;
  ConfigReader top(tree);
  ConfigReading reading(top);
  describeClock(reading, c.cycle, c.stepped);
  if (!top.has("emulator")) {
    throw InputError(tree.where().source +
                     ": has no section 'emulator'; `ballbot drives` needs one");
  }
  reading.section(emulatorSection(), [&](ConfigVisitor& in) { c.describe(in); });
  return c;
}

}  // namespace ballbot
