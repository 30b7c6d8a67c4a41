#include "experiment/rejection_metrics.hpp"

#include <gtest/gtest.h>

namespace ballbot {
namespace {

TEST(RejectionMetrics, NamesEveryReasonAndGivesBackThoseMet) {
  RejectionCounts counts;
  counts.add(Rejection::kImuMissing);
  for (int i = 0; i < 3; ++i) counts.add(Rejection::kWheel1Slip, 1);
  auto metrics = rejectionMetrics(counts);
  EXPECT_EQ(metrics.size(), static_cast<std::size_t>(kRejectionCount));
  EXPECT_EQ(metrics.at("rejected_wheel_2_slip"), 3);
  EXPECT_EQ(metrics.at("rejected_wheel_1_slip"), 0);
  metrics["plans"] = 7;
  const std::map<std::string, double> met{{"imu_missing", 1}, {"wheel_2_slip", 3}};
  EXPECT_EQ(rejectionsAmong(metrics), met);
  EXPECT_EQ(rejectionText(met), "imu_missing 1, wheel_2_slip 3");
  EXPECT_EQ(rejectionText({}), "nothing");
}

}  // namespace
}  // namespace ballbot
