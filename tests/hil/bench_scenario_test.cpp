// The bench scenario end to end: controller - LCM - hil - slcan over pty - drives - plant.
#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/yaml_file.hpp"
#include "cosim/lcm_transport.hpp"
#include "cosim/lifecycle.hpp"
#include "cosim/remote_participant.hpp"
#include "cosim/serve.hpp"
#include "cosim/step_master.hpp"
#include "experiment/plant_factory.hpp"
#include "experiment/robot_controller.hpp"
#include "hil/bus_budget.hpp"
#include "hil/data_sheet_check.hpp"
#include "hil/emulator/serve_drives.hpp"
#include "hil/hil_participant.hpp"
#include "hil/open_can_bus.hpp"
#include "hil/stepped_runner.hpp"
#include "tests/hil/support/quantized_plant.hpp"

namespace ballbot {
namespace {

const std::string kConfigs = std::string(BALLBOT_SOURCE_DIR) + "/configs/";

Scenario benchScenario() {
  return loadScenario(kConfigs + "scenarios/bench_balance.yaml", {"duration_s=2"});
}

/// What a run leaves: every command, bit for bit.
struct BenchRun {
  std::vector<JointVector> torques;
  double largest_tilt = 0;
  std::int64_t saturated = 0;
  double bus_load = 0;
};

BenchRun control(const Scenario& scenario, Participant& participant) {
  EventCalendar calendar(scenario.rates.base_step);
  RobotController controller(readRunConfig(scenario), calendar);
  MasterOptions options;
  options.end = kSimStart + scenario.duration;
  StepMaster master(participant, controller, calendar, nullptr, options);
  BenchRun run;
  master.setObserver([&](const Tick& tick) {
    run.torques.push_back(tick.control.command.torque);
    return true;
  });
  master.run();
  return run;
}

/// Emulated drives with the scenario's plant, served on ptys by a thread of their own.
class LiveDrives {
 public:
  LiveDrives(const Scenario& scenario, const ConfigNode& bench_file)
      : config_(readEmulatorConfig(bench_file)),
        bench_(config_, makePlant(readPlantSetup(scenario))),
        buses_(openEmulatedBuses(config_, {})),
        thread_([this] { serveDrives(bench_, config_, buses_, &stop_); }) {}
  ~LiveDrives() { join(); }
  void join() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  const EmulatedBench& bench() const { return bench_; }

 private:
  EmulatorConfig config_;
  EmulatedBench bench_;
  std::vector<std::unique_ptr<CanBus>> buses_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// A bench file on links of its own. @param name  below configs/hil/
ConfigNode benchFile(const std::string& name, const std::vector<std::string>& overrides) {
  ConfigNode tree = loadYamlFile(kConfigs + "hil/" + name);
  const std::string base = ::testing::TempDir() + "ballbot_can" + std::to_string(::getpid());
  for (const std::string n : {"0", "1"}) {
    applyOverride(tree, "buses." + n + ".address=\"slcan:" + base + n + "\"");
    applyOverride(tree, "emulator.buses." + n + ".link=" + base + n);
  }
  for (const std::string& text : overrides) applyOverride(tree, text);
  return tree;
}

/// The whole chain; `over_lcm` puts LCM between controller and bench.
BenchRun runBench(const Scenario& scenario, const ConfigNode& tree, bool over_lcm) {
  LiveDrives drives(scenario, tree);
  const BenchConfig config = readBenchConfig(tree);
  requireDataSheets(config);
  std::vector<std::unique_ptr<CanBus>> buses;
  std::vector<CanBus*> ends;
  for (const BusConfig& bus : config.buses) {
    buses.push_back(openCanBus(bus.address, bus.settings));
    ends.push_back(buses.back().get());
  }
  SteppedRunner runner(config, ends, std::chrono::seconds(20));
  HilParticipant hil(runner);
  BenchRun run;
  if (over_lcm) {
    const LcmAddress address = privateLcmAddress();
    LcmTransport far_end(address, LinkEnd::kParticipant), near_end(address, LinkEnd::kMaster);
    std::thread server([&] { serve(hil, far_end, {}); });
    RemoteOptions options;
    options.name = "hil";
    options.patience = options.first_patience = std::chrono::minutes(1);
    {
      RemoteParticipant remote(near_end, options);
      run = control(scenario, remote);
    }
    server.join();
  } else {
    Lifecycle life(hil);
    run = control(scenario, life);
  }
  runner.release();
  EXPECT_EQ(runner.bench().safety().state(), SafetyState::kDisabled) << runner.bench().faultText();
  run.saturated = runner.bench().saturatedCycles();
  const CanBusSettings& bus = config.buses[0].settings;
  run.bus_load =
      runner.io().load(0).nominal.microseconds(bus.bitrate_kbps, bus.data_bitrate_kbps) /
      (static_cast<double>(runner.bench().master().cycle()) * config.cycleSeconds() * 1e6);
  // The set-up is in what was counted, and rounding of the heartbeats' periods.
  EXPECT_NEAR(run.bus_load, busBudget(config)[0].nominal, 0.06) << "what the bench file promises";
  drives.join();
  EXPECT_FALSE(drives.bench().anyEnergized()) << "torque stayed on";
  run.largest_tilt = drives.bench().largestTilt();
  return run;
}

void expectSameCommands(const BenchRun& a, const BenchRun& b) {
  ASSERT_EQ(a.torques.size(), b.torques.size());
  for (std::size_t i = 0; i < a.torques.size(); ++i) {
    ASSERT_EQ(a.torques[i], b.torques[i]) << "at tick " << i;
  }
}

TEST(BenchScenario, BalancesOverLcmAndPtyAndIsTheSameTwice) {
  const Scenario scenario = benchScenario();
  const BenchRun first = runBench(scenario, benchFile("bench.yaml", {}), true);
  EXPECT_GT(first.torques.size(), 700U);
  EXPECT_LT(first.largest_tilt, 0.17) << "rad, with the 0.2 s at the end that are only damped";
  EXPECT_GT(first.torques.back().norm(), 0);
  expectSameCommands(first, runBench(scenario, benchFile("bench.yaml", {}), true));
  EXPECT_LT(first.bus_load, 0.62)
      << "of bus 0 at 1 Mbit/s: three drives with three PDOs each, and the IMU";
  RecordProperty("bus_load_permille", static_cast<int>(1000 * first.bus_load));
}

// Drives that deviate: torque and velocity scaled otherwise; no motor encoder, other stop options.
// Their SDO servers are quicker here than they are shipped, which is 15 s of nothing but waiting.
TEST(BenchScenario, BalancesWithTheDrivesOfOtherVendors) {
  const Scenario scenario = loadScenario(kConfigs + "scenarios/bench_balance.yaml", {});
  for (const std::string vendor : {"quistal", "nebelhorn"}) {
    const ConfigNode tree =
        benchFile("vendors/" + vendor + "/bench.yaml", {"emulator.drive_defaults.sdo_delay_ms=2"});
    const BenchRun run = runBench(scenario, tree, false);
    EXPECT_EQ(run.torques.size(), 1601U) << vendor << ": 4 s at 400 Hz";
    EXPECT_LT(run.largest_tilt, 0.17) << vendor << ", rad";
    EXPECT_EQ(run.saturated, 0) << vendor;
  }
}

// The tracker at 2.5 kHz over the bus, which classic CAN has no room for.
TEST(BenchScenario, BalancesAtTwoAndAHalfKilohertzOverCanFd) {
  const Scenario scenario = loadScenario(kConfigs + "scenarios/bench_fd_balance.yaml", {});
  const BenchRun run = runBench(scenario, benchFile("bench_fd.yaml", {}), false);
  EXPECT_EQ(run.torques.size(), 10'001U) << "4 s at 2.5 kHz";
  EXPECT_LT(run.largest_tilt, 0.17) << "rad";
}

// The controller cannot tell the bench from the plant.
TEST(BenchScenario, CommandsEqualThoseAgainstThePlantWithMatchedQuantisation) {
  const Scenario scenario = benchScenario();
  for (const bool synchronous : {false, true}) {
    const BenchRun bench = runBench(
        scenario,
        benchFile("bench.yaml", {synchronous ? "synchronous_outputs=true" : "stepped=true"}),
        false);
    EXPECT_EQ(bench.saturated, 0);
    Lifecycle direct(
        std::make_unique<QuantizedPlant>(makePlant(readPlantSetup(scenario)), 40, synchronous));
    expectSameCommands(control(scenario, direct), bench);
  }
}

}  // namespace
}  // namespace ballbot
