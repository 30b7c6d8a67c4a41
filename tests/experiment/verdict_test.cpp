#include "experiment/verdict.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "core/key_unit.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

MetricLimit limit(const std::string& metric, std::optional<double> below,
                  std::optional<double> above) {
  MetricLimit l;
  l.metric = metric;
  l.below = below;
  l.above = above;
  l.where = {"s.yaml", 3, 5};
  return l;
}

TEST(Verdict, HoldsEachMetricAgainstItsLimits) {
  const auto rows =
      judge({limit("a", 2, {}), limit("a", {}, 2), limit("a", 2, 0.5), limit("a", 1, {})},
            {{"a", 1}}, {"a"});
  EXPECT_TRUE(rows[0].passed);
  EXPECT_EQ(rows[0].limit, "< 2");
  EXPECT_FALSE(rows[1].passed);
  EXPECT_EQ(rows[1].limit, "> 2");
  EXPECT_TRUE(rows[2].passed);
  EXPECT_EQ(rows[2].limit, "0.5 to 2");
  EXPECT_FALSE(rows[3].passed) << "a limit is not below itself";
}

TEST(Verdict, ANumberThatWasNotMeasuredIsMissed) {
  const auto rows = judge({limit("a", 2, {})}, {}, {"a"});
  EXPECT_FALSE(rows[0].measured);
  EXPECT_FALSE(rows[0].passed);
  EXPECT_FALSE(judge({limit("a", 2, {})}, {{"a", std::nan("")}}, {"a"})[0].passed);
}

TEST(Verdict, AnUnknownMetricIsRefusedWithThoseKnown) {
  try {
    judge({limit("beauty", 2, {})}, {}, {"tilt", "drift"});
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(
        e.what(),
        HasSubstr("s.yaml:3:5: requirement on unknown metric 'beauty'; known are: tilt, drift"));
  }
}

TEST(Verdict, UnitsFollowFromNames) {
  EXPECT_EQ(unitOfKey("largest_tilt_deg"), "deg");
  EXPECT_EQ(unitOfKey("velocity_rms_m_per_s"), "m/s");
  EXPECT_EQ(unitOfKey("largest_wheel_torque_Nm"), "N m");
  EXPECT_EQ(unitOfKey("final_ball_position_error_m"), "m");
  EXPECT_EQ(unitOfKey("fell"), "");
}

}  // namespace
}  // namespace ballbot
