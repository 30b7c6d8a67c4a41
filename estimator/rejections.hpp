#pragma once

#include <array>
#include <cstdint>

namespace ballbot {

/// What an estimator does not believe, and why.
enum class Rejection : int {
  kFrameLate,          ///< frame older than the one before
  kFrameAhead,         ///< frame from a second or more after the one before
  kNotFinite,          ///< a sensor value is not a number
  kImuMissing,         ///< interval without an inertial sample
  kImuLate,            ///< inertial sample of an interval that was already gone through
  kImuAhead,           ///< inertial sample from after the frame that brought it
  kAccelSpike,         ///< accelerometer jumped and jumped back
  kGyroSpike,          ///< gyroscope jumped and jumped back
  kAccelInconsistent,  ///< accelerometer against everything else
  kWheel1Outlier,      ///< increment of one interval against everything else
  kWheel2Outlier,
  kWheel3Outlier,
  kWheel1Slip,  ///< increments off for a while, each too little for an outlier
  kWheel2Slip,
  kWheel3Slip,
  kWheel1Stuck,  ///< encoder shows no motion where the others do
  kWheel2Stuck,
  kWheel3Stuck,
  kStateDoubted,  ///< several wheels refused for long: the state was at fault, and was relaxed
  kUpdateFailed,  ///< update without a usable result; the state was relaxed
  kPoseOutlier,   ///< external pose far from the estimate
  kPoseLate,      ///< external pose older than the history kept
  kCount
};
constexpr int kRejectionCount = static_cast<int>(Rejection::kCount);

/// "wheel_2_slip": for records and summaries.
const char* toText(Rejection reason) noexcept;

/// How often each was met; wheels per interval and wheel.
class RejectionCounts {
 public:
  void add(Rejection reason, int wheel = 0) noexcept {
    ++counts_[static_cast<std::size_t>(static_cast<int>(reason) + wheel)];
  }
  std::int64_t operator[](Rejection reason) const noexcept {
    return counts_[static_cast<std::size_t>(reason)];
  }
  std::int64_t total() const noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.counts_);
  }

 private:
  std::array<std::int64_t, kRejectionCount> counts_{};
};

}  // namespace ballbot
