#include "estimator/initial_state.hpp"

#include "core/angle.hpp"
#include "core/config_visitor.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

// What averaging does not remove: the base is held, not frozen.
constexpr double kAccelFloor = 2e-3;    // [m/s^2]
constexpr double kGyroFloor = 1e-4;     // [rad/s]
constexpr double kAccelInMotion = 1.0;  // [m/s^2]

double inverseSquare(double sigma) { return 1 / (sigma * sigma); }

}  // namespace

void InitialUncertainty::describe(ConfigVisitor& v) {
  v.number(may("position_m", "of the ball's place at the release, which is zero by definition"),
           position, {1e-6, 10});
  v.number(may("yaw_deg", "of the yaw at the release, which is zero by definition"), yaw,
           {1e-4, 180}, kRadPerDeg);
  v.number(may("tilt_deg", "of pitch and roll"), tilt, {0.01, 45}, kRadPerDeg);
  v.number(may("velocity_at_rest_m_per_s", "of the ball's velocity, where rest was seen"),
           velocity_at_rest, {1e-5, 10});
  v.number(may("omega_at_rest_rad_per_s", "of the base's angular velocity, where rest was seen"),
           omega_at_rest, {1e-5, 10});
  v.number(may("velocity_unknown_m_per_s", "of the ball's velocity, where no rest was seen"),
           velocity_unknown, {1e-3, 10});
  v.number(may("omega_unknown_rad_per_s", "of the base's angular velocity, where no rest was seen"),
           omega_unknown, {1e-3, 10});
  v.number(may("accel_bias_m_per_s2", "of the accelerometer's bias after switching on"), accel_bias,
           {1e-5, 5});
  v.number(may("gyro_bias_rad_per_s", "of the gyroscope's bias after switching on"), gyro_bias,
           {1e-6, 1});
}

InitialEstimate initialEstimate(const RestAlignment& rest, bool at_rest,
                                const InitialUncertainty& prior, const FilterNoise& noise,
                                double imu_period_s, double gravity) noexcept {
  InitialEstimate out;
  out.x.R_WB = rest.attitude();
  // Along gravity the accelerometer's bias shows; across, it looks like tilt.
  const Vector3& accel = rest.meanAccel();
  if (at_rest && accel.norm() > 0) out.x.accel_bias = accel * (1 - gravity / accel.norm());
  if (at_rest) out.x.gyro_bias = rest.gyroBias();

  TangentMatrix& L = out.information;
  L.setZero();
  const auto prior_on = [&L](int first, int count, double sigma) {
    L.diagonal().segment(first, count).setConstant(inverseSquare(sigma));
  };
  prior_on(kTanPosition, 2, prior.position);
  prior_on(kTanVelocity, 2, at_rest ? prior.velocity_at_rest : prior.velocity_unknown);
  prior_on(kTanOmega, 3, at_rest ? prior.omega_at_rest : prior.omega_unknown);
  prior_on(kTanAccelBias, 3, prior.accel_bias);
  prior_on(kTanGyroBias, 3, prior.gyro_bias);
  const double tilt = inverseSquare(prior.tilt), yaw = inverseSquare(prior.yaw);
  L.block<3, 3>(kTanAttitude, kTanAttitude) =
      out.x.R_WB.transpose() * Vector3(tilt, tilt, yaw).asDiagonal() * out.x.R_WB;
  if (rest.samples() == 0) return out;

  // Rows [f]x d_attitude + d_accel_bias = mean noise, f = R' g z; and d_gyro_bias = mean noise.
  const double n = static_cast<double>(rest.samples());
  const double accel_mean2 = noise.accel_density * noise.accel_density / (imu_period_s * n);
  const double accel_floor = at_rest ? kAccelFloor : kAccelInMotion;
  const double wa = 1 / (accel_mean2 + accel_floor * accel_floor);
  const Matrix3 F = skew(out.x.R_WB.transpose() * Vector3(0, 0, gravity));
  L.block<3, 3>(kTanAttitude, kTanAttitude) += wa * F.transpose() * F;
  L.block<3, 3>(kTanAttitude, kTanAccelBias) = wa * F.transpose();
  L.block<3, 3>(kTanAccelBias, kTanAttitude) = wa * F;
  L.block<3, 3>(kTanAccelBias, kTanAccelBias) += wa * Matrix3::Identity();
  if (at_rest) {
    const double gyro_mean2 = noise.gyro_density * noise.gyro_density / (imu_period_s * n);
    L.diagonal().segment<3>(kTanGyroBias).array() += 1 / (gyro_mean2 + kGyroFloor * kGyroFloor);
  }
  return out;
}

void placeAt(const RestPose& pose, const ExternalPoseSettings& settings,
             InitialEstimate& estimate) noexcept {
  if (pose.samples() == 0) return;
  FilterState& x = estimate.x;
  x.p_WK_W = pose.mean().head<2>();
  const double yaw = yawPitchRollFromRotation(x.R_WB)[0];
  x.R_WB = rotationFromYawPitchRoll(pose.mean()[2] - yaw, 0, 0) * x.R_WB;

  // Tilt is known alike in all directions; so in B nothing but the yaw's own term changes.
  TangentMatrix& L = estimate.information;
  const double n = static_cast<double>(pose.samples());
  L.diagonal().segment<2>(kTanPosition).setConstant(n * inverseSquare(settings.position_sigma_m));
  const Vector3 up_B = x.R_WB.transpose() * Vector3::UnitZ();
  const double yaw_before = up_B.dot(L.block<3, 3>(kTanAttitude, kTanAttitude) * up_B);
  L.block<3, 3>(kTanAttitude, kTanAttitude) +=
      (n * inverseSquare(settings.yaw_sigma_rad) - yaw_before) * up_B * up_B.transpose();
}

}  // namespace ballbot
