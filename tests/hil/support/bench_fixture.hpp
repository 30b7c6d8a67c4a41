#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/yaml_file.hpp"
#include "hil/bench.hpp"
#include "hil/bench_io.hpp"
#include "hil/emulator/emulated_bus.hpp"
#include "hil/emulator/joint_rig.hpp"

namespace ballbot {

/// A bench and emulated drives on a rig in one process, stepped.
class BenchFixture {
 public:
  explicit BenchFixture(const std::string& extra = "", const std::string& emulator = "{rig: {}, ")
      : tree_(parseYaml(yaml(extra, emulator), "bench.yaml")),
        config(steady(readBenchConfig(tree_))),
        emulator_config(readEmulatorConfig(tree_)),
        drives(emulator_config, std::make_unique<JointRig>(JointRigOptions{})),
        bench(config) {
    std::vector<CanBus*> ends;
    for (int i = 0; i < emulator_config.bus_count; ++i) {
      buses.push_back(std::make_unique<EmulatedBus>(drives, i));
      ends.push_back(buses.back().get());
    }
    io = std::make_unique<BenchIo>(bench.master(), ends);
    drives.powerOn();
  }

  /// Resets and configures; false if a node made trouble.
  bool configure() {
    BenchMaster& m = bench.master();
    io->collect(std::chrono::steady_clock::now());  // boot-up messages of switching on
    m.reset();
    for (int i = 0; i < 2000 && !m.configured(); ++i) {
      io->send();
      io->collect(std::chrono::steady_clock::now());
      m.endCycle();
      for (int n = 0; n <= kDriveCount; ++n) {
        if (m.link(n).trouble() != NodeTrouble::kNone) return false;
      }
    }
    if (m.configured()) m.start();
    return m.configured() || m.link(0).phase() == NodeLink::Phase::kRunning;
  }
  /// One cycle, after `skipped` that the drives saw and the bench did not.
  void cycle(int skipped = 0) {
    for (int i = 0; i < skipped * emulator_config.bus_count; ++i) {
      drives.onFrame(i % emulator_config.bus_count, CanFrame{0x080, false, false, 0, {}});
    }
    if (skipped > 0) io->collect(std::chrono::steady_clock::now());  // answers that came too late
    bench.master().beginCycle();
    io->send();
    io->collect(std::chrono::steady_clock::now());
    bench.master().endCycle();
    bench.observe(skipped);
    wishes.bus_down = !io->allUp();
    ++wishes.command_number;  // as from a controller that commands in every cycle
    bench.actuate(wishes);
    io->send();
  }
  /// Up to torque.
  bool engage() {
    if (!configure()) return false;
    wishes.prepare = wishes.engage = true;
    for (int i = 0; i < 40; ++i) {
      cycle();
      if (bench.safety().action() == SafetyAction::kFollow) return true;
    }
    return false;
  }

 private:
  /// Tests command what they like for as long as they like.
  static BenchConfig steady(BenchConfig config) {
    config.safety.command_repeats = 0;
    return config;
  }
  static std::string yaml(const std::string& extra, const std::string& emulator) {
    return "stepped: true\n"
           "buses: [{address: \"slcan:none\"}, {address: \"slcan:none\"}]\n"
           "drives: [{node: 1}, {node: 2}, {node: 3}, {node: 4, bus: 1}, {node: 5, bus: 1}, "
           "{node: 6, bus: 1}]\n" +
           extra + "\nemulator: " + emulator +
           "buses: [{link: a}, {link: b}], drives: [{}, {}, {}, {bus: 1}, {bus: 1}, {bus: 1}]}\n";
  }
  ConfigNode tree_;

 public:
  BenchConfig config;
  EmulatorConfig emulator_config;
  EmulatedBench drives;
  Bench bench;
  std::vector<std::unique_ptr<EmulatedBus>> buses;
  std::unique_ptr<BenchIo> io;
  Bench::Wishes wishes;
};

}  // namespace ballbot
