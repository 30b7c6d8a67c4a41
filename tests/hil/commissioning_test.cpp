// A bench that is not as its file says is found out by commissioning, and a good one passes.
#include "hil/commissioning/commissioning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "hil/commissioning/judgement.hpp"
#include "hil/rehearsal/commissioning_trial.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using Verdict = Judgement::Verdict;

std::string textOf(const CommissioningReport& report) {
  std::string text;
  for (const CommissioningRow& row : report.rows) {
    text += (row.good ? "good  " : "WRONG ") + row.name + ": " + row.words + "\n";
  }
  return text;
}

class CommissioningCases : public ::testing::TestWithParam<int> {};

TEST_P(CommissioningCases, IsFoundAtItsTask) {
  const CommissioningCase c = commissioningCases()[static_cast<std::size_t>(GetParam())];
  const CommissioningReport report = rehearseCommissioning(c, RunnerKind::kStepped);
  EXPECT_EQ(foundBy(report), c.found_by) << c.name << "\n" << textOf(report);
  EXPECT_EQ(report.passed, c.found_by.empty()) << c.name;
  const bool by_torque = c.found_by.empty() || c.found_by.rfind("torque", 0) == 0;
  EXPECT_EQ(report.torque_was_on, by_torque) << "what hands find, torque need not find";
}

INSTANTIATE_TEST_SUITE_P(All, CommissioningCases,
                         ::testing::Range(0, static_cast<int>(commissioningCases().size())));

TEST(Commissioning, TheRealTimeLoopFindsTheSame) {
  for (const std::size_t i : {0U, 1U, 8U, 14U}) {
    const CommissioningCase c = commissioningCases()[i];
    const CommissioningReport report = rehearseCommissioning(c, RunnerKind::kRealTime);
    EXPECT_EQ(foundBy(report), c.found_by) << c.name << "\n" << textOf(report);
    EXPECT_EQ(report.passed, c.found_by.empty());
  }
}

class Idle final : public CommissioningPerson {
 public:
  void begin(const CommissioningTask&) override {}
  void hear(const CommissioningTask&, const std::string&) override {}
  bool allowsTorque() override { return asked = true; }
  bool asked = false;
};

TEST(Commissioning, NothingHasTorqueWhereNobodyDoesAnything) {
  Rehearsal rehearsal(Rehearsal::defaultConfig(), RunnerKind::kStepped);
  Idle person;
  const CommissioningReport report = commission(rehearsal.runner(), person);
  EXPECT_EQ(foundBy(report), "turn wheel 1");
  EXPECT_THAT(report.rows[1].words, HasSubstr("nothing moved"));
  EXPECT_FALSE(report.passed);
  EXPECT_FALSE(person.asked);
  EXPECT_FALSE(rehearsal.torque().torqueOn());
}

/// At rest for a second in one sample, at rest in the other for a second more, moved in between.
HandWatch moved(const BenchSample& from, const BenchSample& to) {
  HandWatch watch(0.0025, 0.05);
  watch.begin();
  for (int i = 0; i < 400; ++i) watch.add(from);
  BenchSample between = from;
  between.joint_velocity[0] = 1;
  watch.add(between);
  for (int i = 0; i < 400; ++i) watch.add(to);
  return watch;
}

CommissioningTask turnOf(int drive, double angle) {
  CommissioningTask t;
  t.kind = CommissioningTask::Kind::kTurnJoint;
  t.drive = drive;
  t.angle = angle;
  return t;
}

TEST(Commissioning, AJointAtItsUpperStopIsTurnedAgainstItsArrow) {
  BenchConfig config = Rehearsal::defaultConfig();
  config.drives[4].limits.position_low = -2;
  config.drives[4].limits.position_high = config.commissioning.arm_pose[1] = 1;
  const CommissioningTask t = commissioningTasks(config)[5];
  EXPECT_LT(t.angle, -1);
  EXPECT_THAT(t.text, HasSubstr("against its arrow"));
  BenchSample to;
  to.joint_angle[4] = to.motor_angle[4] = t.angle;
  EXPECT_EQ(judgeTurn(config, t, moved({}, to)).verdict, Verdict::kGood);
  to.joint_angle[4] = to.motor_angle[4] = -t.angle;
  EXPECT_THAT(judgeTurn(config, t, moved({}, to)).words, HasSubstr("sign is 1 and would be -1"));
}

TEST(HandWatch, CountsFromRestToRestAndTakesTheGyroscopesBiasAway) {
  BenchSample from, to;
  from.joint_angle[2] = 0.3;
  from.gyro = to.gyro = {0.01, 0, 0};
  to.joint_angle[2] = 1.5;
  const HandWatch watch = moved(from, to);
  ASSERT_TRUE(watch.started() && watch.atRest() && watch.hasMoved());
  EXPECT_NEAR(watch.motion().joint[2], 1.2, 1e-9);
  EXPECT_NEAR(watch.motion().turned[0], 0, 1e-6);
}

TEST(HandWatch, HasNotStartedWhileTheRobotMoves) {
  HandWatch watch(0.0025, 0.05);
  BenchSample s;
  s.joint_velocity[4] = 0.2;
  watch.begin();
  for (int i = 0; i < 1000; ++i) watch.add(s);
  EXPECT_FALSE(watch.started());
}

TEST(Judgement, ATurnInTwoPartsIsWaitedFor) {
  const BenchConfig config = Rehearsal::defaultConfig();
  BenchSample to;
  to.joint_angle[3] = to.motor_angle[3] = 40 * kRadPerDeg;
  EXPECT_EQ(judgeTurn(config, turnOf(3, 90 * kRadPerDeg), moved({}, to)).verdict, Verdict::kWait);
  to.joint_angle[3] = to.motor_angle[3] = 88 * kRadPerDeg;
  EXPECT_EQ(judgeTurn(config, turnOf(3, 90 * kRadPerDeg), moved({}, to)).verdict, Verdict::kGood);
  to.joint_angle[3] = to.motor_angle[3] = 130 * kRadPerDeg;
  EXPECT_EQ(judgeTurn(config, turnOf(3, 90 * kRadPerDeg), moved({}, to)).verdict, Verdict::kWrong);
}

TEST(Judgement, AMotorEncoderThatCountsBackwardsIsNamed) {
  const BenchConfig config = Rehearsal::defaultConfig();
  BenchSample to;
  to.joint_angle[0] = kTwoPi;
  to.motor_angle[0] = -kTwoPi;
  const Judgement j = judgeTurn(config, turnOf(0, kTwoPi), moved({}, to));
  EXPECT_EQ(j.verdict, Verdict::kWrong);
  EXPECT_THAT(j.words, HasSubstr("motor_encoder_counts_per_turn"));
}

TEST(Judgement, OneGIsOneG) {
  const BenchConfig config = Rehearsal::defaultConfig();
  BenchSample s;
  s.accel = {0, 0, 4.9};
  EXPECT_THAT(judgeStand(config, moved(s, s)).words, HasSubstr("accel_resolution_m_per_s2"));
  s.accel = {0, 0, 9.81};
  EXPECT_EQ(judgeStand(config, moved(s, s)).verdict, Verdict::kGood);
}

}  // namespace
}  // namespace ballbot
