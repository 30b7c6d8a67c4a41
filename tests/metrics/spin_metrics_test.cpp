#include "metrics/spin_metrics.hpp"

#include <gmock/gmock.h>

namespace ballbot {
namespace {

using testing::DoubleEq;
using testing::Pair;
using testing::UnorderedElementsAre;

TEST(SpinMetrics, AreTheLargestOfAfterTheRelease) {
  SpinMetrics metrics(kSimStart + SimDuration(1'000'000'000));
  EXPECT_TRUE(metrics.values().empty());
  metrics.add(kSimStart, 9, 9, 1);
  EXPECT_TRUE(metrics.values().empty());
  metrics.add(kSimStart + SimDuration(1'000'000'000), -0.5, 0.4, 0.8);
  metrics.add(kSimStart + SimDuration(2'000'000'000), 0.1, -0.3, 0.4);
  EXPECT_THAT(metrics.values(),
              UnorderedElementsAre(Pair("largest_spin_rate_rad_per_s", DoubleEq(0.5)),
                                   Pair("spin_torque_use", DoubleEq(0.75))));
}

TEST(SpinMetrics, AnySpinUsesUpAFloorThatHoldsNothing) {
  SpinMetrics metrics(kSimStart);
  metrics.add(kSimStart, 0.1, 0, 0);
  EXPECT_EQ(metrics.values().at("spin_torque_use"), 1);
}

}  // namespace
}  // namespace ballbot
