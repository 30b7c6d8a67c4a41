#include "hil/bench_config.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

const char* const kNames[kDriveCount] = {"wheel 1", "wheel 2", "wheel 3",
                                         "arm 1",   "arm 2",   "arm 3"};

/// The data sheet that `eds` names, relative to the file in which it stands.
void readDataSheet(ConfigReader& in, NamedDataSheet& out) {
  const ConfigNode* node = in.raw("eds");
  if (node == nullptr) return;
  const std::filesystem::path file = in.text("eds");
  const auto beside = std::filesystem::path(node->where().source).parent_path() / file;
  out.sheet = std::make_shared<const DataSheet>(
      DataSheet::read(file.is_absolute() ? file.string() : beside.string()));
  out.where = toText(node->where());
}

/// Keys that `drive_defaults` and every entry of `drives` may have.
void readDriveValues(ConfigReader& in, DriveConfig& d) {
  readDataSheet(in, d.data_sheet);
  DriveScaling& s = d.scaling;
  if (in.has("torque_reference_object")) {
    try {
      d.torque_reference_object = readObjectAddress(in.text("torque_reference_object"));
    } catch (const InputError& e) {
      throw InputError(in.at("torque_reference_object") + ": " + e.what());
    }
  }
  d.quick_stop_option = in.integerOr("quick_stop_option", d.quick_stop_option, {0, 8});
  d.fault_reaction_option = in.integerOr("fault_reaction_option", d.fault_reaction_option, {0, 4});
  // 0, no action, would let a drive go on without its master.
  d.abort_connection_option =
      in.integerOr("abort_connection_option", d.abort_connection_option, {1, 3});
  s.torque_reference = in.numberOr("rated_torque_Nm", s.torque_reference, {0.001, 1000});
  s.motor_torque_reference =
      in.numberOr("motor_torque_at_rated_current_Nm", s.motor_torque_reference, {0, 1000});
  s.encoder_counts = in.numberOr("encoder_counts_per_turn", s.encoder_counts, {16, 1e9});
  s.motor_encoder_counts =
      in.numberOr("motor_encoder_counts_per_turn", s.motor_encoder_counts, {16, 1e9});
  s.velocity_unit = in.numberOr("velocity_unit_rad_per_s", s.velocity_unit, {1e-9, 10});
  s.sign = in.numberOr("sign", s.sign, {-1, 1});
  if (std::abs(s.sign) != 1) throw InputError(in.at("sign") + " must be 1 or -1");
  s.offset = kRadPerDeg * in.numberOr("offset_deg", s.offset / kRadPerDeg, {-3600, 3600});
  s.spring_stiffness = in.numberOr("spring_stiffness_Nm_per_rad", s.spring_stiffness, {1, 1e6});
  DriveLimits& l = d.limits;
  l.torque = in.numberOr("torque_limit_Nm", l.torque, {kTiny, 1000});
  l.torque_rate = in.numberOr("torque_rate_limit_Nm_per_s", l.torque_rate, {kTiny, 1e6});
  l.velocity = in.numberOr("velocity_limit_rad_per_s", l.velocity, {kTiny, 1000});
  l.position_low = kRadPerDeg * in.numberOr("position_low_deg", l.position_low / kRadPerDeg);
  l.position_high = kRadPerDeg * in.numberOr("position_high_deg", l.position_high / kRadPerDeg);
  d.stiffness = in.numberOr("stiffness_Nm_per_rad", d.stiffness, {0, 1e4});
  d.damping = in.numberOr("damping_Nms_per_rad", d.damping, {0, 1e3});
  d.torque_frequency_Hz = in.numberOr("torque_frequency_Hz", d.torque_frequency_Hz, {1, 5000});
  d.torque_damping_ratio = in.numberOr("torque_damping_ratio", d.torque_damping_ratio, {0.1, 10});
  d.torque_delay = 1e-3 * in.numberOr("torque_delay_ms", 1e3 * d.torque_delay, {0, 100});
  d.off_switch = in.textOr("off_switch", d.off_switch);
}

void readDrives(ConfigReader& in, BenchConfig& c) {
  DriveConfig defaults;
  defaults.scaling.torque_reference = 20;
  defaults.scaling.encoder_counts = 14'400;
  defaults.scaling.motor_encoder_counts = 720'000;
  defaults.scaling.spring_stiffness = 350;
  defaults.scaling.velocity_unit = 0;  // until one is given
  defaults.off_switch = "the emergency stop of the bench (STO)";
  defaults.limits = {4, 2000, 12, -1e6, 1e6};
  if (in.has("drive_defaults")) {
    ConfigReader d = in.child("drive_defaults");
    readDriveValues(d, defaults);
    d.finish();
  }
  std::vector<ConfigReader> list = in.list("drives");
  if (list.size() != kDriveCount) {
    throw InputError(fmt::format("{} has {} entries, must be {}: wheels 1 to 3, arm joints 1 to 3",
                                 in.at("drives"), list.size(), kDriveCount));
  }
  std::set<std::pair<int, int>> nodes{{c.imu.bus, c.imu.node}};
  const double last_bus = static_cast<double>(c.buses.size()) - 1;
  for (int i = 0; i < kDriveCount; ++i) {
    ConfigReader& d = list[static_cast<std::size_t>(i)];
    DriveConfig drive = defaults;
    drive.name = d.textOr("name", kNames[i]);
    drive.bus = d.integerOr("bus", 0, {0, last_bus});
    drive.node = d.integer("node", {1, 126});
    readDriveValues(d, drive);
    if (drive.scaling.velocity_unit == 0) {
      drive.scaling.velocity_unit = kTwoPi / drive.scaling.encoder_counts;
    }
    if (!nodes.insert({drive.bus, drive.node}).second || drive.node == c.master_node) {
      throw InputError(
          fmt::format("{} {} is taken on bus {}", d.at("node"), drive.node, drive.bus));
    }
    if (drive.limits.position_low >= drive.limits.position_high) {
      throw InputError(d.at("position_low_deg") + " must be below position_high_deg");
    }
    d.finish();
    c.drives[static_cast<std::size_t>(i)] = drive;
  }
}

std::vector<PdoMapping> readMappings(ConfigReader& in, const char* key, std::size_t longest,
                                     const std::vector<std::vector<const char*>>& defaults) {
  std::vector<PdoMapping> out;
  const ConfigNode* node = in.raw(key);
  const auto add = [&](std::vector<PdoEntry> entries) {
    try {
      out.emplace_back(std::move(entries));
      if (out.back().bytes() > longest) {
        throw InputError(fmt::format("a PDO of {} bytes; at most {} fit in a {} frame",
                                     out.back().bytes(), longest,
                                     longest > CanFrame::kMaxSize ? "CAN FD" : "classic CAN"));
      }
    } catch (const InputError& e) {
      throw InputError(in.at(key) + ": " + e.what());
    }
  };
  if (node == nullptr) {
    for (const auto& pdo : defaults) {
      std::vector<PdoEntry> entries;
      for (const char* text : pdo) entries.push_back(readPdoEntry(text));
      add(std::move(entries));
    }
    return out;
  }
  for (const ConfigNode& pdo : node->items()) {
    std::vector<PdoEntry> entries;
    for (const ConfigNode& entry : pdo.items()) {
      try {
        entries.push_back(readPdoEntry(entry.text()));
      } catch (const InputError& e) {
        throw InputError(toText(entry.where()) + ": " + e.what());
      }
    }
    add(std::move(entries));
  }
  if (out.empty() || out.size() > 4)
    throw InputError(in.at(key) + " must be 1 to 4 lists of objects");
  return out;
}

void requireMapped(const BenchConfig& c, const std::string& where) {
  const auto mapped = [](const std::vector<PdoMapping>& pdos, std::uint16_t index) {
    for (const PdoMapping& pdo : pdos) {
      if (pdo.find({index, 0})) return true;
    }
    return false;
  };
  const bool torque = c.mode == DriveMode::kTorque;
  using Indices = std::vector<std::uint16_t>;
  for (const std::uint16_t index : Indices{0x6041, 0x6064, 0x6077, 0x606C}) {
    if (!mapped(c.inputs, index)) {
      throw InputError(fmt::format("{}tpdo must have object {:04X}", where, index));
    }
  }
  for (const std::uint16_t index :
       torque ? Indices{0x6040, 0x6071} : Indices{0x6040, 0x60B2, 0x607A}) {
    if (!mapped(c.outputs, index)) {
      throw InputError(fmt::format("{}rpdo must have object {:04X}", where, index));
    }
  }
}

void requireSharable(const BenchConfig& c, std::size_t longest, const std::string& where) {
  if (!c.shared_outputs) return;
  if (c.outputs.size() != 1) {
    throw InputError(fmt::format("{} needs all outputs of a drive in one RPDO, there are {}", where,
                                 c.outputs.size()));
  }
  for (std::size_t bus = 0; bus < c.buses.size(); ++bus) {
    const auto drives = std::count_if(c.drives.begin(), c.drives.end(), [&](const DriveConfig& d) {
      return d.bus == static_cast<int>(bus);
    });
    const std::size_t bytes = static_cast<std::size_t>(drives) * c.outputs[0].bytes();
    if (bytes <= longest) continue;
    throw InputError(fmt::format("{} would need {} bytes in a frame on bus {}, at most {} fit",
                                 where, bytes, bus, longest));
  }
}

void readDoubts(ConfigReader& in, SafetyConfig& s) {
  s.position_jump = in.numberOr("position_jump_rad", s.position_jump, {1e-4, 10});
  s.spring_mismatch = in.numberOr("spring_mismatch_rad", s.spring_mismatch, {1e-5, 10});
  s.torque_mismatch = in.numberOr("torque_mismatch_Nm", s.torque_mismatch, {1e-3, 1000});
  s.torque_mismatch_share = in.numberOr("torque_mismatch_share", s.torque_mismatch_share, {0, 1});
  s.torque_mismatch_cycles =
      in.integerOr("torque_mismatch_cycles", s.torque_mismatch_cycles, {1, 1000});
  s.doubt_cycles = in.integerOr("doubt_cycles", s.doubt_cycles, {1, 1000});
  s.most_misses = in.integerOr("most_misses", s.most_misses, {1, 33});
  s.torque_repeats = in.integerOr("torque_repeats", s.torque_repeats, {0, 1000});
  s.imu_repeats = in.integerOr("imu_repeats", s.imu_repeats, {0, 1000});
  s.read_back_cycles = in.integerOr("read_back_cycles", s.read_back_cycles, {0, 100'000});
  s.command_repeats = in.integerOr("command_repeats", s.command_repeats, {0, 1e6});
}

void readSafety(ConfigReader in, SafetyConfig& s, const BenchConfig& c) {
  const auto cycles = [&](const char* key, int fallback) {
    const SimDuration t = in.durationOr(key, fallback * c.cycle, {0, 1e5});
    return static_cast<int>((t + c.cycle - SimDuration{1}) / c.cycle);
  };
  s.watchdog_cycles = cycles("command_watchdog_ms", s.watchdog_cycles);
  s.damping_cycles = cycles("damping_ms", s.damping_cycles);
  s.ramp_cycles = cycles("ramp_ms", s.ramp_cycles);
  s.heartbeat_cycles = cycles("heartbeat_timeout_ms", s.heartbeat_cycles);
  s.transition_cycles = cycles("transition_timeout_ms", s.transition_cycles);
  s.confirm_cycles = cycles("confirm_off_ms", s.confirm_cycles);
  if (s.confirm_cycles < 1) throw InputError(in.at("confirm_off_ms") + " must be a cycle or more");
  s.stale_cycles = in.integerOr("stale_cycles", s.stale_cycles, {1, 100});
  s.late_cycles = in.integerOr("late_cycles", s.late_cycles, {1, 100});
  s.damping = in.numberOr("damping_Nms_per_rad", s.damping, {0, 100});
  s.damping_torque = in.numberOr("damping_torque_Nm", s.damping_torque, {0, 100});
  s.rest_velocity = in.numberOr("rest_velocity_rad_per_s", s.rest_velocity, {kTiny, 1});
  s.tilt = kRadPerDeg * in.numberOr("tilt_limit_deg", s.tilt / kRadPerDeg, {1, 90});
  s.encoder_mismatch = in.numberOr("encoder_mismatch_rad", s.encoder_mismatch, {1e-4, 10});
  readDoubts(in, s);
  in.finish();
}

void readBuses(ConfigReader& in, BenchConfig& c) {
  for (ConfigReader& b : in.list("buses")) {
    BusConfig bus;
    bus.address = b.text("address");
    CanBusSettings& s = bus.settings;
    s.bitrate_kbps = b.integerOr("bitrate_kbps", s.bitrate_kbps, {10, 1000});
    s.acknowledges = b.booleanOr("acknowledges", s.acknowledges);
    if (b.has("fd")) {
      ConfigReader fd = b.child("fd");
      s.data_bitrate_kbps = fd.integer("data_bitrate_kbps", {1000, 8000});
      fd.finish();
      if (s.data_bitrate_kbps < s.bitrate_kbps) {
        throw InputError(b.at("fd") + " data_bitrate_kbps must not be below bitrate_kbps");
      }
    }
    b.finish();
    if (!c.buses.empty() && c.buses[0].settings.flexible() != s.flexible()) {
      throw InputError(b.at("fd") + " must be there for both buses or for none: PDOs are the same");
    }
    c.buses.push_back(bus);
  }
  if (c.buses.empty() || c.buses.size() > 2)
    throw InputError(in.at("buses") + " must be one or two");
}

void readRealtime(ConfigReader in, BenchConfig& c) {
  c.realtime.priority = in.integerOr("priority", c.realtime.priority, {1, 98});
  c.realtime.collect = in.durationOr("collect_us", c.realtime.collect, {10, 1e5});
  c.realtime.act = in.durationOr("act_us", c.realtime.act, {10, 1e5});
  if (!(c.realtime.collect < c.realtime.act && c.realtime.act < c.cycle)) {
    throw InputError(in.at("act_us") + " must lie between collect_us and the cycle");
  }
  in.finish();
}

void readCommissioning(ConfigReader in, CommissioningConfig& c) {
  c.arm_pose = in.numbersOr<3>("arm_pose_deg", {}, {-360, 360});
  for (double& angle : c.arm_pose) angle *= kRadPerDeg;
  c.torque_share = in.numberOr("torque_share", c.torque_share, {0.02, 0.5});
  in.finish();
}

}  // namespace

int BenchConfig::cyclesOf(int ms) const {
  const SimDuration t = std::chrono::milliseconds(ms);
  return static_cast<int>((t + cycle - SimDuration{1}) / cycle);
}

BenchConfig readBenchConfig(const ConfigNode& tree) {
  BenchConfig c;
  ConfigReader in(tree);
  in.raw("emulator");
  c.scenario_path = in.textOr("scenario", "");
  if (const ConfigNode* set = in.raw("set")) {
    for (const ConfigNode& item : set->items()) c.overrides.push_back(item.text());
  }
  c.cycle = in.durationOr("cycle_us", c.cycle, {200, 100'000});
  c.stepped = in.booleanOr("stepped", false);
  c.master_node = in.integerOr("master_node", c.master_node, {1, 127});
  c.mode = in.choiceOr<DriveMode>(
      "drive_mode", c.mode, {{"torque", DriveMode::kTorque}, {"position", DriveMode::kPosition}});
  c.synchronous_outputs = in.booleanOr("synchronous_outputs", false);
  c.master_heartbeat_ms = in.integerOr("master_heartbeat_ms", c.master_heartbeat_ms, {1, 1000});
  c.master_timeout_ms = in.integerOr("master_timeout_ms", c.master_timeout_ms, {2, 10'000});
  c.drive_heartbeat_ms = in.integerOr("drive_heartbeat_ms", c.drive_heartbeat_ms, {1, 1000});
  c.output_deadline_ms = in.integerOr("output_deadline_ms", c.output_deadline_ms, {0, 1000});
  c.sdo_timeout_ms = in.integerOr("sdo_timeout_ms", c.sdo_timeout_ms, {10, 5000});
  c.boot_timeout_ms = in.integerOr("boot_timeout_ms", c.boot_timeout_ms, {100, 60'000});
  if (c.master_timeout_ms < 2 * c.master_heartbeat_ms) {
    throw InputError(in.at("master_timeout_ms") + " must be at least twice master_heartbeat_ms");
  }
  readBuses(in, c);
  if (in.has("imu")) {
    ConfigReader imu = in.child("imu");
    readDataSheet(imu, c.imu.data_sheet);
    const SimDuration period = imu.durationOr("period_us", c.cycle, {1, 1e5});
    c.imu.period_cycles = static_cast<int>((period + c.cycle - SimDuration{1}) / c.cycle);
    c.imu.bus = imu.integerOr("bus", 0, {0, static_cast<double>(c.buses.size()) - 1});
    c.imu.node = imu.integerOr("node", c.imu.node, {1, 126});
    c.imu.accel_resolution =
        imu.numberOr("accel_resolution_m_per_s2", c.imu.accel_resolution, {1e-6, 1});
    c.imu.gyro_resolution =
        imu.numberOr("gyro_resolution_rad_per_s", c.imu.gyro_resolution, {1e-7, 1});
    imu.finish();
  }
  readDrives(in, c);
  const bool torque = c.mode == DriveMode::kTorque;
  using Defaults = std::vector<std::vector<const char*>>;
  const std::size_t longest = c.flexible() ? CanFrame::kMaxFlexibleSize : CanFrame::kMaxSize;
  c.outputs =
      readMappings(in, "rpdo", longest,
                   torque         ? Defaults{{"60400010", "60710010"}}
                   : c.flexible() ? Defaults{{"60400010", "60B20010", "607A0020", "60B10020"}}
                                  : Defaults{{"60400010", "60B20010", "607A0020"}, {"60B10020"}});
  c.inputs = readMappings(
      in, "tpdo", longest,
      c.flexible()
          ? Defaults{{"60410010", "60770010", "60640020", "606C0020", "60E40120", "60740010"}}
          : Defaults{{"60410010", "60770010", "60640020"}, {"606C0020", "60E40120"}, {"60740010"}});
  c.shared_outputs = in.booleanOr("shared_outputs", false);
  requireSharable(c, longest, in.at("shared_outputs"));
  requireMapped(c, tree.where().source + ": ");
  if (in.has("safety")) readSafety(in.child("safety"), c.safety, c);
  if (in.has("realtime")) readRealtime(in.child("realtime"), c);
  if (in.has("commissioning")) readCommissioning(in.child("commissioning"), c.commissioning);
  in.finish();
  return c;
}

}  // namespace ballbot
