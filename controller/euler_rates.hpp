#pragma once

#include <cmath>

#include "model/state.hpp"

namespace ballbot {

/// dq/dt = T(q) nu with T = blkdiag(1, T3, 1): the Euler angle rates at one pitch and roll, with
/// what a step of an integrator and its derivative need. See model/frames.hpp for T3.
struct EulerRates {
  Matrix3 T3;  ///< takes w_WB_B to rates of (yaw, pitch, roll)
  double cos_pitch, tan_pitch;

  explicit EulerRates(const PositionVector& q) {
    const double sy = std::sin(q[kPitch]), cy = std::cos(q[kPitch]);
    const double sx = std::sin(q[kRoll]), cx = std::cos(q[kRoll]);
    cos_pitch = cy;
    tan_pitch = sy / cy;
    T3 << 0, sx / cy, cx / cy,  //
        0, cx, -sx,             //
        1, tan_pitch * sx, tan_pitch * cx;
  }

  /// T(q) nu.
  VelocityVector rate(const VelocityVector& nu) const {
    VelocityVector out = nu;
    out.segment<3>(kYaw).noalias() = T3 * nu.segment<3>(kOmegaX);
    return out;
  }

  /// d(T(q) nu)/d(pitch, roll), rows (yaw, pitch, roll); all other derivatives are zero.
  Eigen::Matrix<double, 3, 2> derivative(const VelocityVector& nu) const {
    const Vector3 w = nu.segment<3>(kOmegaX);
    const double a = cos_pitch * T3.row(0).dot(w);  // sin(roll) wy + cos(roll) wz
    const double b = T3.row(1).dot(w);
    Eigen::Matrix<double, 3, 2> out;
    out << a * tan_pitch / cos_pitch, b / cos_pitch,  //
        0, -a,                                        //
        a / (cos_pitch * cos_pitch), tan_pitch * b;
    return out;
  }
};

}  // namespace ballbot
