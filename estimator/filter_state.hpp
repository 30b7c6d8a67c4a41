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
  kTanSpin = 16,       ///< of the ball about the vertical [rad/s]; where it is estimated
};
/// Of a filter that takes the ball's spin for zero, and of one that estimates it. What depends on
/// the dimension is a template on it, BasicX<kDim>; X is that of the former.
constexpr int kTangentDim = 16;
constexpr int kSpinTangentDim = 17;
template <int kDim>
using BasicTangentVector = Eigen::Matrix<double, kDim, 1>;
template <int kDim>
using BasicTangentMatrix = Eigen::Matrix<double, kDim, kDim>;
using TangentVector = BasicTangentVector<kTangentDim>;
using TangentMatrix = BasicTangentMatrix<kTangentDim>;

/// What the two-state filter estimates about one instant t_k. `w_WB_B` and `spin` are means over
/// the interval that ends at t_k, because that is what an integrating gyroscope and a wheel's turn
/// deliver; attitude and velocity are those at t_k itself.
struct FilterState {
  Eigen::Vector2d p_WK_W = Eigen::Vector2d::Zero();
  Matrix3 R_WB = Matrix3::Identity();
  Eigen::Vector2d v_WK_W = Eigen::Vector2d::Zero();
  Vector3 w_WB_B = Vector3::Zero();
  Vector3 accel_bias = Vector3::Zero();
  Vector3 gyro_bias = Vector3::Zero();
  double spin = 0;  ///< of the ball about the vertical [rad/s]

  /// This state moved by `delta`; the attitude stays a rotation to rounding.
  template <int kDim>
  FilterState plus(const Eigen::Matrix<double, kDim, 1>& delta) const noexcept;
  /// The delta with from.plus(delta) == *this.
  template <int kDim = kTangentDim>
  BasicTangentVector<kDim> minus(const FilterState& from) const noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.p_WK_W);
    visit(self.R_WB);
    visit(self.v_WK_W);
    visit(self.w_WB_B);
    visit(self.accel_bias);
    visit(self.gyro_bias);
    visit(self.spin);
  }
};

}  // namespace ballbot
