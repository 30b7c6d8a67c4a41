#include "model/frames.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace ballbot {

Matrix3 rotationFromYawPitchRoll(double yaw, double pitch, double roll) {
  return (Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
          Eigen::AngleAxisd(roll, Vector3::UnitX()))
      .toRotationMatrix();
}

Vector3 yawPitchRollFromRotation(const Matrix3& R) {
  return {std::atan2(R(1, 0), R(0, 0)), std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
          std::atan2(R(2, 1), R(2, 2))};
}

Matrix3 eulerRateMatrix(double pitch, double roll) {
  const double sy = std::sin(pitch), cy = std::cos(pitch), sx = std::sin(roll), cx = std::cos(roll);
  Matrix3 T;
  T << 0, sx / cy, cx / cy,  //
      0, cx, -sx,            //
      1, sx * sy / cy, cx * sy / cy;
  return T;
}

PositionVector positionRate(const PositionVector& q, const VelocityVector& nu) {
  PositionVector rate = nu;
  rate.segment<3>(kYaw) = eulerRateMatrix(q[kPitch], q[kRoll]) * nu.segment<3>(kOmegaX);
  return rate;
}

Matrix3 skew(const Vector3& a) {
  Matrix3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

Matrix3 expSO3(const Vector3& phi) {
  const double angle2 = phi.squaredNorm();
  const double angle = std::sqrt(angle2);
  // Series below 1e-4 rad, where their error is under 1e-17.
  const double a = angle > 1e-4 ? std::sin(angle) / angle : 1 - angle2 / 6;
  const double half = angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle2 / 48;
  const Matrix3 S = skew(phi);
  return Matrix3::Identity() + a * S + 2 * half * half * S * S;
}

Vector3 logSO3(const Matrix3& R) {
  const Eigen::Quaterniond q(R);  // accurate at every angle, unlike the trace formula near pi
  const double s = q.vec().norm();
  if (s < 1e-12) return 2.0 / q.w() * q.vec();
  const double angle = 2.0 * std::atan2(s, std::abs(q.w()));
  return std::copysign(angle / s, q.w()) * q.vec();
}

}  // namespace ballbot
