#include "hil/stepped_runner.hpp"

#include <atomic>
#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "hil/emulator/emulated_bus.hpp"
#include "hil/emulator/joint_rig.hpp"
#include "hil/hil_participant.hpp"
#include "hil/rehearsal/tampered_bus.hpp"

namespace ballbot {
namespace {

using std::chrono::seconds;
using std::chrono::steady_clock;
using ::testing::HasSubstr;

/// Stepped runner, a bus that can be tampered with, drives on a rig.
struct SteppedStand {
  SteppedStand()
      : tree(parseYaml("{stepped: true, buses: [{address: none}], drives: [{node: 1}, {node: 2}, "
                       "{node: 3}, {node: 4}, {node: 5}, {node: 6}], emulator: {rig: {}, buses: "
                       "[{link: a}], drives: [{}, {}, {}, {}, {}, {}]}}",
                       "stand")),
        config(readBenchConfig(tree)),
        drives(readEmulatorConfig(tree), std::make_unique<JointRig>(JointRigOptions{})),
        inner(drives, 0),
        bus(inner),
        runner(config, {&bus}) {
    drives.powerOn();
  }
  BenchCommand command(int cycle) const {
    BenchCommand c;
    c.torque.fill(1 + 1e-6 * cycle);
    return c;
  }
  void follow(int cycles) {
    for (int i = 0; i < cycles; ++i, ++at) {
      runner.command(at, command(at));
      runner.sample(at + 1);
    }
  }
  ConfigNode tree;
  BenchConfig config;
  EmulatedBench drives;
  EmulatedBus inner;
  TamperedBus bus;
  SteppedRunner runner;
  int at = 0;
};

TEST(SteppedRunner, HasTheWatchdogOfTheRealTimeOne) {
  SteppedStand s;
  s.runner.engage();
  s.follow(60);
  try {
    s.runner.sample(s.at + 8000);
    FAIL() << "one command held for 20 s";
  } catch (const LostParticipantError& e) {
    EXPECT_THAT(e.what(), HasSubstr("no command from the controller (21, limit 20)"));
  }
  EXPECT_FALSE(s.drives.anyEnergized());
  EXPECT_LT(s.drives.syncs(), 60 + 21 + 80 + 60 + 100);
}

TEST(HilParticipant, RefusesAStepLongerThanOneCommandMayBeInForce) {
  SteppedStand s;
  HilParticipant hil(s.runner);
  hil.enterInitializationMode(kSimStart);
  const SimDuration longest = s.config.safety.watchdog_cycles * s.config.cycle;
  ActuatorCommand command;
  command.torque.fill(1);
  EXPECT_NO_THROW(hil.doStep(kSimStart, longest, command));
  EXPECT_TRUE(s.drives.anyEnergized());
  try {
    hil.doStep(kSimStart + longest, SimDuration{20'000'000'000}, command);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("a step of 20000 ms, at most 50 ms"));
  }
  EXPECT_FALSE(s.drives.anyEnergized()) << "and nobody holds the last torque";
}

// A drive that ignores "disable voltage", as one whose power stage is stuck: every frame on its way
// is what a healthy drive would obey, so the emulated one keeps its torque.
void ignoreDisable(TamperedBus& bus, int node, bool quick_stop_too) {
  bus.onWayToDrives([=](const CanFrame& f, std::vector<CanFrame>& out) {
    CanFrame g = f;
    const bool disable = f.size >= 2 && f.data[0] == 0x00, quick = f.data[0] == 0x02;
    if (f.id == 0x200U + static_cast<unsigned>(node) && (disable || (quick && quick_stop_too))) {
      g.data[0] = 0x0F;
      g.data[2] = 50;  // 1 N m
    }
    out.push_back(g);
  });
}

TEST(SteppedRunner, StopsADriveThatIgnoresDisableVoltageByQuickStop) {
  SteppedStand s;
  s.runner.engage();
  s.follow(60);
  ignoreDisable(s.bus, 3, false);
  s.runner.release();
  EXPECT_FALSE(s.drives.anyEnergized());
  EXPECT_TRUE(s.runner.bench().torqueIsOff()) << s.runner.bench().lastWord();
  EXPECT_THROW(s.runner.requireGoodEnd(), LostParticipantError) << "but not with exit code 0";
}

TEST(SteppedRunner, StopsADriveThatIgnoresQuickStopTooByNmtStop) {
  SteppedStand s;
  s.runner.engage();
  s.follow(60);
  ignoreDisable(s.bus, 3, true);
  s.runner.release();
  EXPECT_FALSE(s.drives.anyEnergized());
  EXPECT_TRUE(s.runner.bench().torqueIsOff()) << s.runner.bench().lastWord();
  EXPECT_EQ(s.runner.bench().safety().fault(), BenchFault::kDriveTransition);
}

TEST(SteppedRunner, SaysLoudlyThatADriveObeysNothing) {
  SteppedStand s;
  s.runner.engage();
  s.follow(60);
  ignoreDisable(s.bus, 3, true);
  s.bus.onWayToDrives([](const CanFrame& f, std::vector<CanFrame>& out) {
    const bool to_three = f.id == 0x000 && f.size == 2 && f.data[1] == 3;
    const bool by_sdo = f.id == 0x603 && f.data[1] == 0x40 && f.data[2] == 0x60;
    if (!to_three && !by_sdo) out.push_back(f);
  });
  HilParticipant hil(s.runner);
  try {
    hil.terminate();
    FAIL() << "passed, with torque on";
  } catch (const TorqueNotOffError& e) {
    EXPECT_THAT(e.what(), HasSubstr("TORQUE MAY STILL BE ON: node 3 (wheel 3, bus 0)"));
    EXPECT_THAT(e.what(), HasSubstr("operation enabled"));
  }
  EXPECT_TRUE(s.drives.anyEnergized());
}

TEST(SteppedRunner, EndsWithinSecondsOfCtrlCWhileFramesAreLost) {
  SteppedStand s;
  std::atomic<bool> stop{false};
  s.runner.setStopFlag(&stop);
  s.runner.engage();
  s.follow(60);
  int count = 0;
  s.bus.onWayToMaster([&count](const CanFrame& f, std::vector<CanFrame>& out) {
    if ((f.id & 0x780U) != 0x180 || ++count % 7 != 0) out.push_back(f);
  });
  stop = true;
  const auto begun = steady_clock::now();
  EXPECT_THROW(s.follow(10), std::exception);
  EXPECT_LT(steady_clock::now() - begun, seconds(6));
  EXPECT_FALSE(s.drives.anyEnergized());
}

TEST(SteppedRunner, EndsOnCtrlCWhileItSetsTheDrivesUp) {
  SteppedStand s;
  const std::atomic<bool> stop{true};
  s.runner.setStopFlag(&stop);
  EXPECT_THROW(s.runner.engage(), InterruptedError);
  EXPECT_FALSE(s.drives.anyEnergized());
}

}  // namespace
}  // namespace ballbot
