// No false alarms: robot, drives and controller on the stepped bench, with every check watching.
// More of it: BALLBOT_UNDISTURBED="SECONDS FIRST_SEED LAST_SEED [reduced_wheels]"
// build/release/tests/hil_scenario_test; the last word takes the multibody model that is six times
// as fast.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/yaml_file.hpp"
#include "cosim/lifecycle.hpp"
#include "cosim/step_master.hpp"
#include "experiment/plant_factory.hpp"
#include "experiment/robot_controller.hpp"
#include "hil/emulator/emulated_bus.hpp"
#include "hil/hil_participant.hpp"
#include "hil/stepped_runner.hpp"

namespace ballbot {
namespace {

const std::string kConfigs = std::string(BALLBOT_SOURCE_DIR) + "/configs/";

struct Calm {
  const char* name;
  const char* scenario;
  std::vector<std::string> changes;
};

std::vector<Calm> calmScenarios() {
  const std::vector<std::string> bus_rate = {"rates.tracker_period_us=2500",
                                             "rates.estimator_period_us=2500",
                                             "rates.planner_period_us=15000", "requirements={}"};
  std::vector<std::string> circle = bus_rate;
  circle.push_back("controller.mpc.tasks.ball_position.reference.moves.0.at_s=1");
  return {
      {"balance", "bench_balance", {}},
      {"pushed",
       "bench_balance",
       {"environment={pushes: [{body: base, point_m: [0, 0, 0.35], force_N: [0, 15, 0], start_s: "
        "1.5, duration_s: 0.5}, {body: base, point_m: [0, 0, 0.35], force_N: [15, 0, 0], start_s: "
        "6, duration_s: 0.5}]}"}},
      {"far_from_rest", "bench_balance", {"initial.pitch_deg=3", "initial.roll_deg=-2"}},
      {"simple_wheels", "bench_realtime", {}},
      {"circle", "circle", circle},
  };
}

/// Largest of what the checks look at, over all runs.
struct Largest {
  double torque = 0, spring = 0;
};

void run(const Calm& calm, int seed, double seconds, const std::string& multibody,
         Largest& largest) {
  std::vector<std::string> changes = calm.changes;
  if (!multibody.empty()) changes.push_back("plant.fidelity.multibody=" + multibody);
  changes.push_back("duration_s=" + std::to_string(seconds));
  changes.push_back("seed=" + std::to_string(seed));
  const Scenario scenario =
      loadScenario(kConfigs + "scenarios/" + calm.scenario + ".yaml", changes);
  const ConfigNode tree = loadYamlFile(kConfigs + "hil/bench.yaml");
  EmulatedBench drives(readEmulatorConfig(tree), makePlant(readPlantSetup(scenario)));
  EmulatedBus bus0(drives, 0), bus1(drives, 1);
  SteppedRunner runner(readBenchConfig(tree), {&bus0, &bus1});
  drives.powerOn();
  Lifecycle hil(std::make_unique<HilParticipant>(runner));
  EventCalendar calendar(scenario.rates.base_step);
  RobotController controller(readRunConfig(scenario), calendar);
  MasterOptions options;
  options.end = kSimStart + scenario.duration;
  StepMaster master(hil, controller, calendar, nullptr, options);
  std::string stopped;
  master.setObserver([&](const Tick&) {
    for (int i = 0; i < kDriveCount; ++i) {
      const DriveDoubt& d = runner.bench().driveDoubt(i);
      largest.torque = std::max(largest.torque, std::abs(d.torqueMismatch()));
      largest.spring = std::max(largest.spring, std::abs(d.springMismatch()));
    }
    return true;
  });
  EXPECT_NO_THROW(master.run()) << calm.name << ", seed " << seed << ": "
                                << runner.bench().faultText();
  EXPECT_EQ(runner.bench().safety().fault(), BenchFault::kNone) << runner.bench().faultText();
  EXPECT_TRUE(runner.bench().torqueIsOff()) << runner.bench().lastWord();
  EXPECT_EQ(runner.bench().parameters().unanswered(), 0);
}

TEST(Undisturbed, NoCheckFires) {
  double seconds = 3;
  int first = 1, last = 1;
  std::string multibody;
  if (const char* more = std::getenv("BALLBOT_UNDISTURBED")) {
    std::istringstream(more) >> seconds >> first >> last >> multibody;
  }
  Largest largest;
  for (const Calm& calm : calmScenarios()) {
    for (int seed = first; seed <= last; ++seed) {
      Largest here;
      run(calm, seed, seconds, multibody, here);
      std::printf("%-14s seed %2d: torque %.3f Nm, spring %.5f rad unexplained at most\n",
                  calm.name, seed, here.torque, here.spring);
      std::fflush(stdout);
      largest = {std::max(largest.torque, here.torque), std::max(largest.spring, here.spring)};
    }
  }
  RecordProperty("largest_torque_mismatch_mNm", static_cast<int>(1000 * largest.torque));
  RecordProperty("largest_spring_mismatch_urad", static_cast<int>(1e6 * largest.spring));
}

}  // namespace
}  // namespace ballbot
