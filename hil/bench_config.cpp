#include "hil/bench_config.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "hil/bench_clock.hpp"

namespace ballbot {
namespace {

const char* const kNames[kDriveCount] = {"wheel 1", "wheel 2", "wheel 3",
                                         "arm 1",   "arm 2",   "arm 3"};

using Defaults = std::vector<std::vector<const char*>>;

PdoMapping mappingOf(std::vector<PdoEntry> entries, std::size_t longest) {
  PdoMapping out(std::move(entries));
  if (out.bytes() > longest) {
    throw InputError(fmt::format("a PDO of {} bytes; at most {} fit in a {} frame", out.bytes(),
                                 longest, longest > CanFrame::kMaxSize ? "CAN FD" : "classic CAN"));
  }
  return out;
}

std::vector<PdoMapping> mappingsOf(const Defaults& pdos, std::size_t longest) {
  std::vector<PdoMapping> out;
  for (const auto& pdo : pdos) {
    std::vector<PdoEntry> entries;
    for (const char* text : pdo) entries.push_back(readPdoEntry(text));
    out.push_back(mappingOf(std::move(entries), longest));
  }
  return out;
}

void describeMappings(ConfigVisitor& v, const ConfigKey& key, std::size_t longest,
                      std::vector<PdoMapping>& out) {
  v.other(key, "1 to 4 lists of objects, as in 60640020: index, sub-index, bits",
          [&](ConfigReader& in) {
            out.clear();
            for (const ConfigNode& pdo : in.raw(key.name)->items()) {
              std::vector<PdoEntry> entries;
              for (const ConfigNode& entry : pdo.items()) {
                try {
                  entries.push_back(readPdoEntry(entry.text()));
                } catch (const InputError& e) {
                  throw InputError(toText(entry.where()) + ": " + e.what());
                }
              }
              try {
                out.push_back(mappingOf(std::move(entries), longest));
              } catch (const InputError& e) {
                throw InputError(in.at(key.name) + ": " + e.what());
              }
            }
            if (out.empty() || out.size() > 4)
              throw InputError(in.at(key.name) + " must be 1 to 4 lists of objects");
          });
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

/// What drives are taken for where the file says nothing.
DriveConfig usualDrive() {
  DriveConfig d;
  d.scaling.torque_reference = 20;
  d.scaling.encoder_counts = 14'400;
  d.scaling.motor_encoder_counts = 720'000;
  d.scaling.spring_stiffness = 350;
  d.scaling.velocity_unit = 0;  // until one is given
  d.off_switch = "the emergency stop of the bench (STO)";
  d.limits = {4, 2000, 12, -6e7 * kRadPerDeg, 6e7 * kRadPerDeg};
  return d;
}

}  // namespace

int BenchConfig::cyclesOf(int ms) const {
  const SimDuration t = std::chrono::milliseconds(ms);
  return static_cast<int>((t + cycle - SimDuration{1}) / cycle);
}

std::size_t BenchConfig::longestPdo() const {
  return flexible() ? CanFrame::kMaxFlexibleSize : CanFrame::kMaxSize;
}

void BenchConfig::describeNetwork(ConfigVisitor& v) {
  v.integer(may("master_node", "of the adapter"), master_node, {1, 127});
  v.choice(may("drive_mode",
               "what drives are sent: torque, or a position with offsets for PD in the drive"),
           mode, {{"torque", DriveMode::kTorque}, {"position", DriveMode::kPosition}});
  v.boolean(may("synchronous_outputs", "RPDOs act at the next SYNC instead of on reception"),
            synchronous_outputs);
  v.integer(may("master_heartbeat_ms", "from one heartbeat of the adapter to the next"),
            master_heartbeat_ms, {1, 1000});
  v.integer(may("master_timeout_ms",
                "without one, after which drives stop; at least twice master_heartbeat_ms"),
            master_timeout_ms, {2, 10'000});
  v.integer(may("drive_heartbeat_ms", "from one heartbeat of a drive to the next"),
            drive_heartbeat_ms, {1, 1000});
  v.integer(may("output_deadline_ms",
                "event timer of the RPDOs: a drive without outputs for so long stops; 0: none"),
            output_deadline_ms, {0, 1000});
  v.integer(may("sdo_timeout_ms", "for one answer, in the set-up and in `hil --check`"),
            sdo_timeout_ms, {10, 5000});
  v.integer(may("boot_timeout_ms", "from a node's reset to its boot-up message"), boot_timeout_ms,
            {100, 60'000});
  v.check([this](const ConfigReader& in) {
    if (master_timeout_ms >= 2 * master_heartbeat_ms) return;
    throw InputError(in.at("master_timeout_ms") + " must be at least twice master_heartbeat_ms");
  });
}

void BenchConfig::describeBuses(ConfigVisitor& v) {
  v.list(must("buses", "CAN buses: one, or two"), [this](ConfigVisitor& in) {
    BusConfig bus;
    bus.describe(in);
    in.check([&](const ConfigReader& at) {
      if (buses.empty() || buses[0].settings.flexible() == bus.settings.flexible()) return;
      throw InputError(at.at("fd") +
                       " must be there for both buses or for none: PDOs are the same");
    });
    buses.push_back(bus);
  });
  v.check([this](const ConfigReader& in) {
    if (buses.empty() || buses.size() > 2) throw InputError(in.at("buses") + " must be one or two");
  });
}

void BenchConfig::describeDrives(ConfigVisitor& v) {
  DriveConfig defaults = usualDrive();
  v.section(may("drive_defaults", "what drives have in common"),
            [&](ConfigVisitor& in) { defaults.describe(in); });
  const double last_bus = static_cast<double>(buses.size()) - 1;
  std::set<std::pair<int, int>> nodes{{imu.bus, imu.node}};
  std::size_t count = 0;
  v.list(must("drives", "wheels 1 to 3, arm joints 1 to 3"), [&](ConfigVisitor& in) {
    DriveConfig drive = defaults;
    drive.name = kNames[std::min<std::size_t>(count, kDriveCount - 1)];
    in.text(may("name", "in messages; by default wheel 1 to 3, arm 1 to 3"), drive.name);
    in.integer(may("bus", "on which it is: 0, or 1"), drive.bus, v.depending({0, last_bus}));
    in.integer(must("node", "its CANopen node"), drive.node, {1, 126});
    drive.describe(in);
    in.check([&](const ConfigReader& at) {
      if (!nodes.insert({drive.bus, drive.node}).second || drive.node == master_node) {
        throw InputError(
            fmt::format("{} {} is taken on bus {}", at.at("node"), drive.node, drive.bus));
      }
      if (drive.limits.position_low >= drive.limits.position_high) {
        throw InputError(at.at("position_low_deg") + " must be below position_high_deg");
      }
    });
    if (drive.scaling.velocity_unit == 0) {
      drive.scaling.velocity_unit = kTwoPi / drive.scaling.encoder_counts;
    }
    if (count < kDriveCount) drives[count] = drive;
    ++count;
  });
  v.check([&](const ConfigReader& in) {
    if (count == kDriveCount) return;
    throw InputError(fmt::format("{} has {} entries, must be {}: wheels 1 to 3, arm joints 1 to 3",
                                 in.at("drives"), count, kDriveCount));
  });
}

void BenchConfig::describe(ConfigVisitor& v) {
  v.text(may("scenario", "the robot behind emulated drives, and the run's rates; beside this file"),
         scenario_path);
  v.other(may("set", "changes of the scenario"), "list of path=value", [this](ConfigReader& in) {
    for (const ConfigNode& item : in.raw("set")->items()) overrides.push_back(item.text());
  });
  describeClock(v, cycle, stepped);
  describeNetwork(v);
  describeBuses(v);
  v.section(may("imu", "where it is, and what it counts in"), [this](ConfigVisitor& in) {
    imu.describe(in, cycle, static_cast<double>(buses.size()) - 1);
  });
  describeDrives(v);
  describeMappings(v, may("rpdo", "outputs of each drive, by drive_mode where nothing is said"),
                   longestPdo(), outputs);
  describeMappings(v, may("tpdo", "inputs of each drive, by the kind of bus where nothing is said"),
                   longestPdo(), inputs);
  v.boolean(may("shared_outputs", "one RPDO for all drives of a bus"), shared_outputs);
  v.section(may("safety", "what stops the bench, and how"),
            [this](ConfigVisitor& in) { safety.describe(in, cycle); });
  v.section(may("realtime", "the loop's priority and times"),
            [this](ConfigVisitor& in) { realtime.describe(in, cycle); });
  v.section(may("commissioning", "what `hil --commission` is told"),
            [this](ConfigVisitor& in) { commissioning.describe(in); });
}

BenchConfig readBenchConfig(const ConfigNode& tree) {
  BenchConfig c;
  ConfigReader in(tree);
  in.raw("emulator");
  readDescribed(in, c);
  in.finish();
  const bool torque = c.mode == DriveMode::kTorque;
  const std::size_t longest = c.longestPdo();
  if (c.outputs.empty()) {
    c.outputs =
        mappingsOf(torque         ? Defaults{{"60400010", "60710010"}}
                   : c.flexible() ? Defaults{{"60400010", "60B20010", "607A0020", "60B10020"}}
                                  : Defaults{{"60400010", "60B20010", "607A0020"}, {"60B10020"}},
                   longest);
  }
  if (c.inputs.empty()) {
    c.inputs = mappingsOf(c.flexible() ? Defaults{{"60410010", "60770010", "60640020", "606C0020",
                                                   "60E40120", "60740010"}}
                                       : Defaults{{"60410010", "60770010", "60640020"},
                                                  {"606C0020", "60E40120"},
                                                  {"60740010"}},
                          longest);
  }
  requireSharable(c, longest, in.at("shared_outputs"));
  requireMapped(c, tree.where().source + ": ");
  return c;
}

}  // namespace ballbot
