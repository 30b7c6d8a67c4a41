#pragma once

#include <Eigen/Core>

#include "core/time.hpp"
#include "model/state.hpp"

namespace ballbot {

/// What a filter thinks of itself at the time of its own state, which is that of the last inertial
/// sample; for whoever holds that against the truth.
struct SelfAssessment {
  SimTime time{};
  /// Covariance of the errors of tilt about the horizontal axes of W [rad] and of vx, vy [m/s].
  Eigen::Matrix4d tilt_velocity_covariance = Eigen::Matrix4d::Zero();
  double nis = 0;                        ///< normalised innovation squared of the last update
  int nis_degrees = 0;                   ///< its degrees of freedom, which are its expectation
  Vector3 accel_bias = Vector3::Zero();  ///< as estimated, in B [m/s^2]
  Vector3 gyro_bias = Vector3::Zero();   ///< likewise [rad/s]
};

}  // namespace ballbot
