#include "metrics/wheel_metrics.hpp"

#include <gtest/gtest.h>

namespace ballbot {
namespace {

SimTime at(int ms) { return kSimStart + std::chrono::milliseconds(ms); }

TEST(WheelMetrics, NothingIsMeasuredWhereNothingIsKnown) {
  WheelMetrics metrics(at(10), 0.5);
  EXPECT_TRUE(metrics.values().empty());
  metrics.add(at(0), {100, 100, 100}, {90, 0, 0}, {1, 0, 0});              // before it counts
  metrics.add(at(20), Vector3::Zero(), Vector3::Zero(), Vector3::Zero());  // held by a stand
  EXPECT_TRUE(metrics.values().empty());
}

TEST(WheelMetrics, AreOfTheWorstWheel) {
  WheelMetrics metrics(at(0), 0.5);
  metrics.add(at(10), {100, 80, 60}, {-10, 20, 15}, {0.01, -0.001, 0});
  metrics.add(at(20), {100, 80, 0.5}, {0, 0, 10},
              {-0.03, 0, 0});  // hardly touches: its use is none
  metrics.add(at(25), {100, 80, -3}, {0, 0, 0}, {0, 0.5, 0});
  metrics.add(at(45), {100, 80, 50}, {0, 0, 0}, {0, 0, 0});
  const auto values = metrics.values();
  EXPECT_DOUBLE_EQ(values.at("largest_traction_use"), 0.5);
  EXPECT_DOUBLE_EQ(values.at("least_wheel_normal_force_N"), -3);
  EXPECT_DOUBLE_EQ(values.at("largest_wheel_slip_m_per_s"), 0.5);
  EXPECT_NEAR(values.at("wheel_slip_s"), 0.015, 1e-12);
  EXPECT_EQ(values.size(), WheelMetrics::names().size());
}

}  // namespace
}  // namespace ballbot
