// The checks themselves, without bus or drives: what each sees, and what it must not mind.
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "core/yaml_file.hpp"
#include "hil/bench_fault.hpp"
#include "hil/doubt/command_doubt.hpp"
#include "hil/doubt/drive_doubt.hpp"
#include "hil/doubt/imu_doubt.hpp"
#include "hil/doubt/miss_window.hpp"
#include "hil/doubt/parameter_watch.hpp"
#include "hil/doubt/torque_model.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

BenchConfig config() {
  return readBenchConfig(
      parseYaml("{buses: [{address: none}], drives: [{node: 1}, {node: 2}, {node: 3}, {node: 4}, "
                "{node: 5}, {node: 6}]}",
                "doubt"));
}

// ---- the table and its pages

std::string textOf(const std::string& path) {
  std::ifstream in(std::string(BALLBOT_SOURCE_DIR) + "/docs/" + path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(CheckTable, EveryCheckHasWordsOfItsOwnAndAPageThatNamesIt) {
  std::set<std::string> names, words;
  const std::string table = textOf("hil.md");
  for (const Check& c : checkTable()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    EXPECT_TRUE(words.insert(c.words).second) << c.words;
    if (c.fault == BenchFault::kNone) continue;
    EXPECT_NE(c.reaction, FirstReaction::kNone) << c.name;
    EXPECT_GT(c.bound_cycles, 0) << c.name;
    const std::string page = textOf(std::string("troubleshooting/") + c.page);
    EXPECT_THAT(page, HasSubstr(c.words)) << c.page;
    EXPECT_THAT(table, HasSubstr(std::string("| `") + c.name + "` | " + c.words + " |"));
  }
}

// ---- torque model

TEST(TorqueModel, IsTheSecondOrderResponseExactly) {
  const double w = kTwoPi * 30, d = 0.4, period = 0.0025, delay = 0.001;
  TorqueModel model(w, d, delay, period);
  model.advance(1);
  for (int n = 1; n < 40; ++n) {
    const double t = n * period - delay, a = d * w, wd = w * std::sqrt(1 - d * d);
    const double step = 1 - std::exp(-a * t) * (std::cos(wd * t) + a / wd * std::sin(wd * t));
    EXPECT_NEAR(model.torque(), step, 1e-12) << n;
    model.advance(1);
  }
}

// ---- one drive

/// A drive that does what it is told, and a joint that turns steadily.
struct Honest {
  explicit Honest(const BenchConfig& c) : scale(c.drives[0].scaling) {}
  void step(std::int64_t counts, double velocity = 1) {
    told = counts;
    model.advance(scale.torque(counts));
    seen.fresh = seen.enabled = true;
    seen.angle += 0.0025 * velocity;
    seen.velocity = velocity;
    seen.torque = model.torque();
    seen.motor_angle = seen.angle + seen.torque / scale.spring_stiffness;
    seen.demand = counts;
  }
  DriveScaling scale;
  TorqueModel model{kTwoPi * 40, 0.7071067811865476, 0, 0.0025};
  DriveSeen seen;
  std::int64_t told = 0;
};

std::int64_t wave(int n) { return std::lround(100 * std::sin(0.1 * n)); }

/// Cycles until the finding that `spoil` provokes from cycle 50 on, and which it is.
std::pair<int, BenchFault> provoke(const std::function<void(DriveSeen&, int)>& spoil) {
  const BenchConfig c = config();
  DriveDoubt doubt(c, 0);
  Honest drive(c);
  for (int n = 0; n < 450; ++n) {
    drive.step(wave(n));
    DriveSeen seen = drive.seen;
    if (n >= 50) spoil(seen, n - 50);
    const Finding found = doubt.check(seen, drive.told);
    if (found) return {n - 50 + 1, found.fault};
  }
  return {0, BenchFault::kNone};
}

TEST(DriveDoubt, MindsNothingThatAnHonestDriveDoes) {
  EXPECT_EQ(provoke([](DriveSeen&, int) {}).second, BenchFault::kNone);
  EXPECT_EQ(provoke([](DriveSeen& s, int n) { s.fresh = n % 9 != 0; }).second, BenchFault::kNone)
      << "missing samples are another check's business";
}

TEST(DriveDoubt, SeesEachOfItsFaultsWithinItsBound) {
  const auto expect = [](BenchFault fault, const std::function<void(DriveSeen&, int)>& spoil) {
    const auto [cycles, found] = provoke(spoil);
    EXPECT_EQ(found, fault) << toText(found) << " for " << toText(fault);
    EXPECT_LE(cycles, checkOf(fault).bound_cycles + 10) << toText(fault);
  };
  expect(BenchFault::kPositionJump, [](DriveSeen& s, int) {
    s.angle += 0.04;
    s.motor_angle += 0.04;
  });
  expect(BenchFault::kSpringDisagrees, [](DriveSeen& s, int) { s.motor_angle += 0.006; });
  expect(BenchFault::kEchoDiffers, [](DriveSeen& s, int) { s.demand += 2; });
  expect(BenchFault::kTorqueDiffers, [](DriveSeen& s, int) {
    s.motor_angle -= 2 * s.torque / 350;
    s.torque = -s.torque;
  });
  expect(BenchFault::kEncoderImplausible, [](DriveSeen& s, int n) {
    s.angle += 0.0025 * n;
    s.motor_angle += 0.0025 * n;
  });
}

// Holding still, a torque is the same for as long as one likes; cycles count from where it should
// move. A bus by the wall clock brings the first change two cycles late.
TEST(DriveDoubt, ATorqueThatStoodStillMayBeginToMoveLate) {
  const BenchConfig c = config();
  for (const bool ever : {true, false}) {
    DriveDoubt doubt(c, 0);
    Honest drive(c);
    std::array<double, 2> late{};
    BenchFault fault = BenchFault::kNone;
    int n = 0;
    for (; n < 200 && fault == BenchFault::kNone; ++n) {
      drive.step(n < 100 ? 0 : 12);
      DriveSeen seen = drive.seen;
      seen.torque = ever ? late[0] : 0;
      seen.motor_angle = seen.angle + seen.torque / drive.scale.spring_stiffness;
      late = {late[1], drive.seen.torque};
      fault = doubt.check(seen, drive.told).fault;
    }
    EXPECT_EQ(fault, ever ? BenchFault::kNone : BenchFault::kTorqueRepeats);
    EXPECT_LE(n, ever ? 200 : 100 + c.safety.torque_repeats + 2);
  }
}

TEST(DriveDoubt, AGapMayBringAJointFurtherButNotAnywhere) {
  for (const double jump : {0.0, 0.5}) {
    const auto [cycles, found] = provoke([jump](DriveSeen& s, int n) {
      if (n < 2) s.fresh = false;
      s.angle += jump;
      s.motor_angle += jump;
    });
    EXPECT_EQ(found, jump == 0 ? BenchFault::kNone : BenchFault::kPositionJump) << cycles;
  }
}

// ---- IMU, PDOs, parameters, commands

TEST(ImuDoubt, SeesRepeatedValuesAndNotStillness) {
  ImuDoubt doubt(config());
  const std::array<double, 3> up{0, 0, 1};
  for (int n = 0; n < 100; ++n) {
    const std::array<double, 3> accel{0.00479 * (n % 2), 0, 9.81}, gyro{0, 0.001 * (n % 3), 0};
    ASSERT_FALSE(doubt.check(0.0025, accel, gyro, up)) << "least significant bits are enough";
  }
  int n = 0;
  const std::array<double, 3> gyro{0, 0.001, 0};
  while (!doubt.check(0.0025, {0.00479 * (n % 2), 0, 9.81}, gyro, up) && n < 100) ++n;
  EXPECT_LE(n, checkOf(BenchFault::kImuRepeats).bound_cycles);
}

TEST(MissWindow, CountsHoweverTheyAreSpread) {
  MissWindow w;
  for (int n = 0; n < 100; ++n) w.add(n % 4 == 0);
  EXPECT_EQ(w.count(), MissWindow::kCycles / 4);
  for (int n = 0; n < MissWindow::kCycles; ++n) w.add(false);
  EXPECT_EQ(w.count(), 0);
}

TEST(ParameterWatch, GoesRoundAllDrivesAndNamesWhatHasChanged) {
  const BenchConfig c = config();
  std::vector<std::vector<SetupStep>> setups;
  for (const DriveConfig& drive : c.drives) setups.push_back(driveSetup(c, drive));
  ParameterWatch watch(setups);
  ASSERT_GE(watch.size(), 6 * 5);
  EXPECT_LE(watch.size() * c.safety.read_back_cycles,
            checkOf(BenchFault::kParameterChanged).bound_cycles);
  std::set<int> drives;
  bool found = false;
  for (int i = 0; i < watch.size(); ++i) {
    const ParameterWatch::Question q = watch.next();
    drives.insert(q.drive);
    if (q.drive != 3 || !(q.object == ObjectAddress{0x6072, 0})) continue;
    const Finding finding = watch.onAnswer(true, 1500);
    found = true;
    EXPECT_EQ(finding.fault, BenchFault::kParameterChanged);
    EXPECT_EQ(finding.drive, 3);
    EXPECT_EQ(watch.text(), "6072:00 max torque is 1500, was set to 200");
  }
  EXPECT_TRUE(found);
  EXPECT_EQ(drives.size(), 6U);
  EXPECT_FALSE(watch.onAnswer(false, 0)) << "silence is no change";
  EXPECT_EQ(watch.unanswered(), 1);
}

TEST(CommandDoubt, SeesOrderAgeRepetitionAndWhatCannotBeMeant) {
  const BenchConfig c = config();
  CommandDoubt doubt(c);
  BenchCommand command;
  command.torque.fill(1);
  EXPECT_FALSE(doubt.check(&command, 5));
  EXPECT_EQ(doubt.check(&command, 4).fault, BenchFault::kCommandOrder);
  doubt.rest();
  int n = 0;
  while (!doubt.check(&command, 100) && n < 1000) ++n;
  EXPECT_EQ(n, c.safety.watchdog_cycles + 1) << "one that is new, and so many that are not";
  doubt.rest();
  int number = 1000;
  Finding found;
  for (n = 0; n < 1000 && !found; ++n) found = doubt.check(&command, ++number);
  EXPECT_EQ(found.fault, BenchFault::kCommandRepeats);
  EXPECT_EQ(n, c.safety.command_repeats + 1);
  doubt.rest();
  const BenchCommand idle;
  for (n = 0; n < 1000; ++n) ASSERT_FALSE(doubt.check(&idle, ++number)) << "nothing may repeat";
  command.damping[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(doubt.check(&command, ++number).fault, BenchFault::kCommandNotFinite);
}

}  // namespace
}  // namespace ballbot
