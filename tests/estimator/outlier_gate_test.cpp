#include "estimator/outlier_gate.hpp"

#include <cstring>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "estimator/information_filter.hpp"
#include "estimator/rejections.hpp"
#include "tests/estimator/support/smooth_motion.hpp"

namespace ballbot::test {
namespace {

TEST(SpikeGate, StopsASpikeAndPassesAStepOneSampleLate) {
  SpikeGate gate(1.0);
  const Vector3 low = Vector3::Zero(), high(0, 0, 5);
  EXPECT_TRUE(gate.accepts(low));
  EXPECT_FALSE(gate.accepts(high));  // a spike
  EXPECT_TRUE(gate.accepts(low));
  EXPECT_FALSE(gate.accepts(high));  // a step
  EXPECT_TRUE(gate.accepts(high));
  EXPECT_TRUE(gate.accepts(high));
}

TEST(SpikeGate, PassesAnAccelerationBeyondItsLimitOneSampleLate) {
  SpikeGate gate(0.15);
  const auto at = [](double rate) { return Vector3(0, 0, rate); };
  EXPECT_TRUE(gate.accepts(at(0)));
  EXPECT_FALSE(gate.accepts(at(0.2)));  // may be a spike
  for (int i = 2; i < 20; ++i) EXPECT_TRUE(gate.accepts(at(0.2 * i))) << i;
  EXPECT_FALSE(gate.accepts(at(9)));
  EXPECT_TRUE(gate.accepts(at(3.8)));
}

/// A filter on a robot standing still, fed with one increment of wheel 2 at a time.
class WheelGateTest : public testing::Test {
 protected:
  WheelGateTest() : filter_(estimatorTestRobot(), FilterNoise{}, GateSettings{}, 0.03, 2) {
    TangentVector sigma;
    sigma << 1e-3, 1e-3, 3e-3, 3e-3, 3e-3, 2e-3, 2e-3, 1e-3, 1e-3, 1e-3, 0.03, 0.03, 0.03, 2e-4,
        2e-4, 2e-4;
    filter_.initialise({}, sigma.cwiseInverse().cwiseAbs2().asDiagonal());
  }
  void step(double wheel2_rad_per_s, double wheel3_rad_per_s = 0) {
    IntervalMeasurement m;
    m.h = 2.5e-3;
    m.has_accel = m.has_gyro = true;
    m.accel_B << 0, 0, 9.81;
    m.has_wheel.fill(true);
    m.wheel_increment << 0, m.h * wheel2_rad_per_s, m.h * wheel3_rad_per_s;
    filter_.step(m, counts_);
  }
  InformationFilter filter_;
  RejectionCounts counts_;
};

TEST_F(WheelGateTest, RefusesOnlyTheWheelThatIsOff) {
  for (int i = 0; i < 50; ++i) step(0);
  EXPECT_EQ(counts_.total(), 0);
  EXPECT_EQ(filter_.nisDegrees(), 4);
  step(2.0);
  EXPECT_EQ(counts_[Rejection::kWheel2Outlier], 1);
  EXPECT_EQ(counts_.total(), 1);
  EXPECT_EQ(filter_.nisDegrees(), 3);
  EXPECT_LT(filter_.state().v_WK_W.norm(), 1e-12);
  step(0);
  EXPECT_EQ(counts_.total(), 1);
}

TEST_F(WheelGateTest, NoticesASlowSlipThatNoSingleIncrementShows) {
  for (int i = 0; i < 50; ++i) step(0);
  for (int i = 0; i < 80; ++i) step(0.3);  // three standard deviations
  EXPECT_GT(counts_[Rejection::kWheel2Slip], 40);
  EXPECT_EQ(counts_[Rejection::kWheel1Slip] + counts_[Rejection::kWheel3Slip], 0);
  EXPECT_LT(filter_.state().v_WK_W.norm(), 0.3 * 0.064);
  const std::int64_t before = counts_[Rejection::kWheel2Slip];
  for (int i = 0; i < 100; ++i) step(0);
  const std::int64_t after = counts_[Rejection::kWheel2Slip];
  EXPECT_LT(after - before, 40);  // is trusted again
  for (int i = 0; i < 100; ++i) step(0);
  EXPECT_EQ(counts_[Rejection::kWheel2Slip], after);
}

TEST_F(WheelGateTest, DoubtsTheStateWhereSeveralWheelsDisagreeForLong) {
  for (int i = 0; i < 50; ++i) step(0);
  const double sure = filter_.covariance()(kTanVelocity, kTanVelocity);
  // A ball that rolls along x, which the inertial sensors did not see coming.
  for (int i = 0; i < 25; ++i) step(-5.0, 5.0);
  EXPECT_EQ(counts_[Rejection::kStateDoubted], 1);
  EXPECT_GT(filter_.covariance()(kTanAttitude, kTanAttitude), 100 * sure);
  for (int i = 0; i < 50; ++i) step(-5.0, 5.0);
  // Now it is believed: 5 rad/s of wheels 2 and 3 is this velocity.
  EXPECT_NEAR(filter_.state().v_WK_W.x(), 5.0 / 9.568, 0.02);
}

TEST_F(WheelGateTest, SurvivesAnUpdateThatCannotBeSolved) {
  for (int i = 0; i < 10; ++i) step(0);
  step(std::nan(""));
  EXPECT_EQ(counts_[Rejection::kUpdateFailed], 1);
  for (int i = 0; i < 200; ++i) step(0);
  EXPECT_TRUE(filter_.information().allFinite());
  EXPECT_LT(filter_.state().v_WK_W.norm(), 1e-6);
}

TEST(WheelGate, LeavesAStuckEncoderOutWhileItsWheelHappensToStand) {
  WheelGate gate(GateSettings{});
  RejectionCounts counts;
  IntervalMeasurement m;
  m.h = 2.5e-3;
  m.has_wheel.fill(true);
  m.wheel_increment << 0.01, 0, -0.01;
  Vector3 off(0, 10, 0);
  for (int i = 0; i < 20; ++i) gate.settle(off, m, {true, false, true}, counts);
  EXPECT_GT(counts[Rejection::kWheel2Stuck], 10);
  off.setZero();
  for (int i = 0; i < 200; ++i) gate.settle(off, m, gate.usable(m.has_wheel), counts);
  EXPECT_FALSE(gate.usable(m.has_wheel)[1]);
  m.wheel_increment[1] = 0.01;
  gate.settle(off, m, gate.usable(m.has_wheel), counts);
  EXPECT_TRUE(gate.usable(m.has_wheel)[1]);
}

TEST(Rejections, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (int i = 0; i < kRejectionCount; ++i) names.insert(toText(static_cast<Rejection>(i)));
  EXPECT_EQ(static_cast<int>(names.size()), kRejectionCount);
  EXPECT_STREQ(toText(Rejection::kWheel2Slip), "wheel_2_slip");
  EXPECT_STREQ(toText(Rejection::kPoseLate), "pose_late");
}

}  // namespace
}  // namespace ballbot::test
