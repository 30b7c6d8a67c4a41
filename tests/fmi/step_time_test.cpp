#include "fmi/step_time.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace ballbot {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(StepTime, TakesTheStepThatWasMeant) {
  EXPECT_EQ(stepTarget(simTimeFromNs(0), 0, 0.009999999999999998, {}).end,
            simTimeFromNs(10'000'000));
  EXPECT_EQ(stepTarget(simTimeFromNs(10'000'000), 0.0099999999999, 0.0004, {}).end,
            simTimeFromNs(10'400'000));
  EXPECT_EQ(stepTarget(simTimeFromNs(0), 0, 1.0 / 3, {}).end, simTimeFromNs(333'333'333));
  EXPECT_EQ(stepTarget(simTimeFromNs(0), 0, 1e-9, {}).end, simTimeFromNs(1));
}

// An importer that adds steps up, for an hour of simulated time at 60 Hz: its sum is off by more
// than a nanosecond at its end, but no step is lost or doubled, and none is off by more than the
// sum.
TEST(StepTime, LosesNoStepInAnHourOf60Hz) {
  SimTime now{};
  double t = 0;
  for (int k = 1; k <= 216'000; ++k) {
    const StepTarget target = stepTarget(now, t, 1.0 / 60, {});
    ASSERT_EQ(target.refusal, "") << k;
    t += 1.0 / 60;
    const double off = 2e-9 + 2 * std::abs(t - k / 60.0);
    ASSERT_NEAR(toSeconds(target.end - now), 1.0 / 60, off) << k;
    now = target.end;
    ASSERT_NEAR(toSeconds(now), k / 60.0, off) << k;
  }
  EXPECT_NEAR(toSeconds(now), 3600, 1e-6);
}

TEST(StepTime, StaysOnWholeStepsWhileTheSumDrifts) {
  SimTime now{};
  double t = 0;
  for (std::int64_t k = 1; k <= 1'000'000; ++k) {
    const StepTarget target = stepTarget(now, t, 0.001, {});
    ASSERT_EQ(toNs(target.end), k * 1'000'000) << target.refusal;
    now = target.end;
    t += 0.001;
  }
}

TEST(StepTime, RefusesWhatIsNoStep) {
  const SimTime now = simTimeFromNs(1'000'000'000);
  for (const double step : {kNan, kInfinite, -kInfinite, 0.0, -0.01, 1e300}) {
    EXPECT_THAT(stepTarget(now, 1, step, {}).refusal, HasSubstr("step size is")) << step;
  }
  EXPECT_THAT(stepTarget(now, 1, 1e-12, {}).refusal, HasSubstr("at least a nanosecond"));
  for (const double point : {kNan, kInfinite, 1e300}) {
    EXPECT_THAT(stepTarget(now, point, 0.01, {}).refusal, HasSubstr("communication point is"));
  }
  for (const double point : {0.0, 0.999999, 1.000001}) {
    EXPECT_THAT(stepTarget(now, point, 0.01, {}).refusal,
                HasSubstr("but the plant stands at 1.000000000 s"));
  }
  EXPECT_THAT(stepTarget(now, 1, 0.01, simTimeFromNs(1'005'000'000)).refusal,
              HasSubstr("past the stop time"));
  EXPECT_EQ(stepTarget(now, 1, 0.01 * (1 + 1e-12), simTimeFromNs(1'010'000'000)).refusal, "");
}

}  // namespace
}  // namespace ballbot
