#include "tests/estimator/support/simulated_sensors.hpp"

#include <cmath>

#include "core/angle.hpp"

namespace ballbot::test {
namespace {

Vector3 normals(const RandomStream& stream, std::int64_t index) {
  const std::array<double, 4> n = stream.normals(static_cast<std::uint64_t>(index));
  return {n[0], n[1], n[2]};
}

}  // namespace

SensorNoise noNoise() {
  SensorNoise n;
  n.gyro_sigma = n.accel_sigma = n.gyro_bias_sigma = n.accel_bias_sigma = 0;
  n.gyro_bias_walk = n.accel_bias_walk = 0;
  return n;
}

SensorNoise whiteNoise() {
  SensorNoise n;
  n.wheel_increment_sigma = 0.1 * 2.5e-3;
  return n;
}

SensorNoise quantisedNoise() {
  SensorNoise n;
  n.encoder_step = 0.025 * kRadPerDeg;
  return n;
}

SimulatedSensors::SimulatedSensors(const MotionScript& script, const RobotParameters& robot,
                                   const SensorNoise& noise, std::uint64_t seed)
    : script_(script),
      robot_(robot),
      noise_(noise),
      gyro_(seed, "gyro"),
      accel_(seed, "accel"),
      gyro_bias_(seed, "gyro_bias"),
      accel_bias_(seed, "accel_bias"),
      wheel_(seed, "wheel") {
  truth_.motion = sampleMotion(script_, robot_, 0.0);
  truth_.gyro_bias = noise_.gyro_bias_sigma * normals(gyro_bias_, 0);
  truth_.accel_bias = noise_.accel_bias_sigma * normals(accel_bias_, 0);
}

void SimulatedSensors::advance() {
  const double h = 1e-9 * kImuPeriodNs;
  const double from = h * static_cast<double>(tick_);
  ++tick_;
  const double to = h * static_cast<double>(tick_);
  const MotionMeans mean = averageMotion(script_, robot_, from, to);

  truth_.t_s = to;
  truth_.motion = sampleMotion(script_, robot_, to);
  truth_.mean_w_WB_B = mean.w_WB_B;
  truth_.mean_spin = mean.spin;
  truth_.gyro_bias += noise_.gyro_bias_walk * std::sqrt(h) * normals(gyro_bias_, tick_);
  truth_.accel_bias += noise_.accel_bias_walk * std::sqrt(h) * normals(accel_bias_, tick_);

  frame_.time = frame_.imu_time = simTimeFromNs(tick_ * kImuPeriodNs);
  frame_.imu_count = tick_;
  frame_.gyro_WB_B = mean.w_WB_B + truth_.gyro_bias + noise_.gyro_sigma * normals(gyro_, tick_);
  frame_.accel_B =
      mean.specific_force_B + truth_.accel_bias + noise_.accel_sigma * normals(accel_, tick_);
  wheel_angle_ += h * mean.wheel_rates + noise_.wheel_increment_sigma * normals(wheel_, tick_);
  for (int i = 0; i < kWheelCount; ++i) {
    const double step = noise_.encoder_step;
    frame_.joint_angle[i] = step > 0 ? step * std::round(wheel_angle_[i] / step) : wheel_angle_[i];
  }
  frame_.joint_velocity.head<kWheelCount>() = truth_.motion.wheel_rates;
  frame_.joint_torque.head<kWheelCount>() = twist(mean.spin, truth_.motion.R_WB);
}

/// Of wheels that keep a ball spinning, or creeping, on a floor that holds 0.4 N m.
Vector3 SimulatedSensors::twist(double spin, const Matrix3& R_WB) const {
  const Vector3 up_B = R_WB.row(2);
  Vector3 per_wheel;  // on the ball about the vertical
  for (int i = 0; i < kWheelCount; ++i) {
    per_wheel[i] = -robot_.ball.radius / robot_.wheels.radius * robot_.wheelAxle(i).dot(up_B);
  }
  return 0.4 * std::tanh(spin / 0.02) / per_wheel.squaredNorm() * per_wheel;
}

}  // namespace ballbot::test
