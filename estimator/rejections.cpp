#include "estimator/rejections.hpp"

#include <numeric>

namespace ballbot {

const char* toText(Rejection reason) noexcept {
  static constexpr std::array<const char*, kRejectionCount> kNames = {
      "frame_late",         "frame_ahead",     "not_finite",      "imu_missing",
      "imu_late",           "imu_ahead",       "accel_spike",     "gyro_spike",
      "accel_inconsistent", "wheel_1_outlier", "wheel_2_outlier", "wheel_3_outlier",
      "wheel_1_slip",       "wheel_2_slip",    "wheel_3_slip",    "wheel_1_stuck",
      "wheel_2_stuck",      "wheel_3_stuck",   "state_doubted",   "update_failed",
      "pose_outlier",       "pose_late"};
  return reason < Rejection::kCount ? kNames[static_cast<std::size_t>(reason)] : "unknown";
}

std::int64_t RejectionCounts::total() const noexcept {
  return std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0});
}

}  // namespace ballbot
