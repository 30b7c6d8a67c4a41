#pragma once

#include "model/state.hpp"

namespace ballbot {

/// R_WB = Rz(yaw) Ry(pitch) Rx(roll).
Matrix3 rotationFromYawPitchRoll(double yaw, double pitch, double roll);

/// (yaw, pitch, roll) of a rotation, pitch in [-pi/2, pi/2].
Vector3 yawPitchRollFromRotation(const Matrix3& R_WB);

/// Takes w_WB_B to the rates of (yaw, pitch, roll). Singular at pitch = +-90 degrees.
Matrix3 eulerRateMatrix(double pitch, double roll);

/// dq/dt = T(q) nu.
PositionVector positionRate(const PositionVector& q, const VelocityVector& nu);

/// Rotation by the vector `phi` [rad]: exponential map of SO(3).
Matrix3 expSO3(const Vector3& phi);
/// Rotation vector of R, angle in [0, pi]: logarithm of SO(3).
Vector3 logSO3(const Matrix3& R);
/// skew(a) b = a x b.
Matrix3 skew(const Vector3& a);

}  // namespace ballbot
