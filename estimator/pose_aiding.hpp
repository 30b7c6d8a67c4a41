#pragma once

#include "estimator/external_pose.hpp"
#include "estimator/information_filter.hpp"
#include "estimator/rejections.hpp"
#include "model/signals.hpp"

namespace ballbot {

/// What a filter makes of external poses: while the robot is held, where it stands; afterwards
/// measurements of position and yaw that arrive late, some of which are wrong, and which may show
/// that the robot stands quite otherwise than was believed. Free of allocation; for the control
/// step.
class PoseAiding {
 public:
  /// @param yaw_sigma of the robot's placing, which counts at the first pose of a run that saw none
  /// while held [rad]
  PoseAiding(const ExternalPoseSettings& settings, double yaw_sigma)
      : settings_(settings), yaw_sigma_(yaw_sigma) {}

  /// A pose of a robot that is held.
  void takeAtRest(const Vector3& pose_W, RejectionCounts& counts) noexcept;
  const RestPose& atRest() const { return rest_; }

  /// Where the filter is now; once per interval. @param yaw continuous [rad]
  void tell(SimTime time, const FilterState& x, double yaw) noexcept;
  /// A pose of a robot in motion: corrects the filter, and the yaw with it.
  template <int kDim>
  void take(const SensorFrame& frame, SimTime time, BasicInformationFilter<kDim>& filter,
            double& yaw, RejectionCounts& counts) noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.rest_);
    visit(self.history_);
    visit(self.heading_known_);
    visit(self.refused_);
  }

 private:
  template <int kDim>
  void bringInTheHeading(BasicInformationFilter<kDim>& filter) noexcept;
  template <int kDim>
  bool believes(const PoseRows& rows, BasicInformationFilter<kDim>& filter,
                RejectionCounts& counts) noexcept;

  ExternalPoseSettings settings_;
  double yaw_sigma_;  ///< [rad]
  RestPose rest_;
  PoseHistory history_;
  bool heading_known_ = false;  ///< a pose has said it, or has been compared with it
  int refused_ = 0;             ///< in a row
};

}  // namespace ballbot
