#pragma once

#include "model/state.hpp"

namespace ballbot {

/// Where each part of the filter's state stands in its tangent vector.
enum TangentIndex : int {
  kTanPosition = 0,    ///< ball centre px, py in W [m]
  kTanAttitude = 2,    ///< R exp(.), rotation vector in B [rad]
  kTanVelocity = 5,    ///< of the ball centre vx, vy in W [m/s]
  kTanOmega = 7,       ///< w_WB_B [rad/s]
  kTanAccelBias = 10,  ///< [m/s^2]
  kTanGyroBias = 13,   ///< [rad/s]
};
constexpr int kTangentDim = 16;
using TangentVector = Eigen::Matrix<double, kTangentDim, 1>;
using TangentMatrix = Eigen::Matrix<double, kTangentDim, kTangentDim>;

/// What the two-state filter estimates about one instant t_k. `w_WB_B` is the mean over the
/// interval that ends at t_k, because that is what an integrating gyroscope delivers; attitude and
/// velocity are those at t_k itself.
struct FilterState {
  Eigen::Vector2d p_WK_W = Eigen::Vector2d::Zero();
  Matrix3 R_WB = Matrix3::Identity();
  Eigen::Vector2d v_WK_W = Eigen::Vector2d::Zero();
  Vector3 w_WB_B = Vector3::Zero();
  Vector3 accel_bias = Vector3::Zero();
  Vector3 gyro_bias = Vector3::Zero();

  /// This state moved by `delta`; the attitude stays a rotation to rounding.
  FilterState plus(const TangentVector& delta) const noexcept;
  /// The delta with from.plus(delta) == *this.
  TangentVector minus(const FilterState& from) const noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.p_WK_W);
    visit(self.R_WB);
    visit(self.v_WK_W);
    visit(self.w_WB_B);
    visit(self.accel_bias);
    visit(self.gyro_bias);
  }
};

}  // namespace ballbot
