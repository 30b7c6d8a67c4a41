#include "plant/sensors.hpp"

#include <cmath>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

Vector3 firstThree(const std::array<double, 4>& v) { return {v[0], v[1], v[2]}; }

Vector3 quantized(const Vector3& v, double quantum) {
  return v.unaryExpr([quantum](double x) { return ballbot::quantized(x, quantum); });
}

double lowPassShare(double bandwidth_Hz, double period) {
  return 1 - std::exp(-2 * kPi * bandwidth_Hz * period);
}

}  // namespace

double quantized(double value, double quantum) noexcept {
  return quantum > 0 ? quantum * std::nearbyint(value / quantum) : value;
}

void ImuParameters::describe(ConfigVisitor& v) {
  const Range not_negative{0, kInf};
  v.duration(must("period_ms", "from one sample to the next; a sample is the average over it"),
             period, {1e-3, 1000});
  v.number(must("gyro_noise_rad_per_s_per_sqrtHz", "density of the gyroscope's white noise"),
           gyro_noise, not_negative);
  v.number(must("accel_noise_m_per_s2_per_sqrtHz", "density of the accelerometer's white noise"),
           accel_noise, not_negative);
  v.number(must("gyro_bias_walk_rad_per_s_per_sqrts", "random walk of the gyroscope's bias"),
           gyro_bias_walk, not_negative);
  v.number(must("accel_bias_walk_m_per_s2_per_sqrts", "random walk of the accelerometer's bias"),
           accel_bias_walk, not_negative);
  v.number(must("gyro_turn_on_bias_rad_per_s",
                "standard deviation of the gyroscope's bias after switching on"),
           gyro_turn_on_bias, not_negative);
  v.number(must("accel_turn_on_bias_m_per_s2",
                "standard deviation of the accelerometer's bias after switching on"),
           accel_turn_on_bias, not_negative);
  v.number(must("gyro_resolution_rad_per_s", "quantum of the gyroscope's output, 0 for none"),
           gyro_resolution, not_negative);
  v.number(must("accel_resolution_m_per_s2", "quantum of the accelerometer's output, 0 for none"),
           accel_resolution, not_negative);
}

void EncoderParameters::describe(ConfigVisitor& v) {
  v.number(must("motor_resolution_deg", "quantum of the encoder behind the gear, joint side"),
           motor_resolution, {0, kInf}, kRadPerDeg);
  v.number(must("joint_resolution_deg", "quantum of the encoder behind the spring"),
           joint_resolution, {0, kInf}, kRadPerDeg);
  v.number(may("motor_velocity_filter_Hz", "low-pass on the differenced motor angle"),
           motor_velocity_filter, {kTiny, kInf});
  v.number(must("velocity_filter_Hz", "low-pass on the differenced joint angle"),
           joint_velocity_filter, {kTiny, kInf});
}

void SensorParameters::describe(ConfigVisitor& v) {
  v.section(must("imu", "inertial measurement unit: what the device adds to true averages"),
            [&](ConfigVisitor& in) { imu.describe(in); });
  v.section(must("encoders", "two per joint, behind the gear and behind the spring"),
            [&](ConfigVisitor& in) { encoders.describe(in); });
}

Imu::Imu(const ImuParameters& p, bool noisy, std::uint64_t seed)
    : p_(p),
      noisy_(noisy),
      gyro_noise_(seed, "imu.gyro_noise"),
      accel_noise_(seed, "imu.accel_noise"),
      gyro_walk_(seed, "imu.gyro_bias_walk"),
      accel_walk_(seed, "imu.accel_bias_walk"),
      turn_on_(seed, "imu.turn_on_bias") {
  reset();
}

void Imu::reset() {
  last_ = Sample{};
  if (!noisy_) return;
  gyro_bias_ = p_.gyro_turn_on_bias * firstThree(turn_on_.normals(0));
  accel_bias_ = p_.accel_turn_on_bias * firstThree(turn_on_.normals(1));
}

void Imu::sample(SimTime time, const Vector3& mean_specific_force, const Vector3& mean_rate) {
  const auto index = static_cast<std::uint64_t>(last_.count++);
  last_.time = time;
  last_.accel_B = mean_specific_force;
  last_.gyro_WB_B = mean_rate;
  if (!noisy_) return;
  // White noise of density n, averaged over T, has variance n^2 / T; a walk of w gains w^2 T.
  const double root_T = std::sqrt(toSeconds(p_.period));
  last_.gyro_WB_B += gyro_bias_ + p_.gyro_noise / root_T * firstThree(gyro_noise_.normals(index));
  last_.accel_B += accel_bias_ + p_.accel_noise / root_T * firstThree(accel_noise_.normals(index));
  last_.gyro_WB_B = quantized(last_.gyro_WB_B, p_.gyro_resolution);
  last_.accel_B = quantized(last_.accel_B, p_.accel_resolution);
  gyro_bias_ += p_.gyro_bias_walk * root_T * firstThree(gyro_walk_.normals(index));
  accel_bias_ += p_.accel_bias_walk * root_T * firstThree(accel_walk_.normals(index));
}

JointEncoders::JointEncoders(const EncoderParameters& p, bool ideal, SimDuration tick)
    : ideal_(ideal),
      motor_resolution_(ideal ? 0 : p.motor_resolution),
      joint_resolution_(ideal ? 0 : p.joint_resolution),
      tick_s_(toSeconds(tick)),
      motor_share_(lowPassShare(p.motor_velocity_filter, tick_s_)),
      joint_share_(lowPassShare(p.joint_velocity_filter, tick_s_)) {}

JointVector JointEncoders::motorAngle(const JointMotion& motion) const {
  return motion.rotor_angle.unaryExpr([this](double x) { return quantized(x, motor_resolution_); });
}

JointVector JointEncoders::jointAngle(const JointMotion& motion) const {
  return motion.angle.unaryExpr([this](double x) { return quantized(x, joint_resolution_); });
}

void JointEncoders::reset(const JointMotion& motion) {
  readings_ = JointReadings{};
  readings_.motor_angle = motorAngle(motion);
  readings_.joint_angle = jointAngle(motion);
}

void JointEncoders::tick(const JointMotion& motion) {
  JointReadings& r = readings_;
  const JointVector motor = motorAngle(motion), joint = jointAngle(motion);
  if (ideal_) {
    r.motor_velocity = motion.rotor_velocity;
    r.joint_velocity = motion.velocity;
  } else {
    r.motor_velocity += motor_share_ * ((motor - r.motor_angle) / tick_s_ - r.motor_velocity);
    r.joint_velocity += joint_share_ * ((joint - r.joint_angle) / tick_s_ - r.joint_velocity);
  }
  r.motor_angle = motor;
  r.joint_angle = joint;
}

}  // namespace ballbot
