#pragma once

#include "estimator/rejections.hpp"
#include "model/wheel_flags.hpp"

namespace ballbot {

/// Which wheels an estimator refused since it was last asked, as wheels that turn as the ball does
/// not. An encoder that shows no motion tells nothing about its wheel.
class RefusedWheels {
 public:
  /// @param joint_velocity  of the frame that the estimator was given [rad/s]
  WheelFlags since(const RejectionCounts& counts, const JointVector& joint_velocity) noexcept {
    WheelFlags out{};
    for (int i = 0; i < kWheelCount; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const std::int64_t now =
          of(counts, Rejection::kWheel1Outlier, i) + of(counts, Rejection::kWheel1Slip, i);
      out[at] = now > seen_[at] && joint_velocity[i] != 0;
      seen_[at] = now;
    }
    return out;
  }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.seen_);
  }

 private:
  static std::int64_t of(const RejectionCounts& counts, Rejection first, int wheel) noexcept {
    return counts[static_cast<Rejection>(static_cast<int>(first) + wheel)];
  }
  std::array<std::int64_t, kWheelCount> seen_{};
};

}  // namespace ballbot
