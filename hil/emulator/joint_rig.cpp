#include "hil/emulator/joint_rig.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "core/angle.hpp"
#include "core/digest.hpp"
#include "core/error.hpp"
#include "model/pd_law.hpp"

namespace ballbot {
namespace {

constexpr double kInertia = 0.05, kFriction = 0.2, kSpring = 350;
constexpr double kLongestStep = 1e-4;  // of the joint's motion [s]
constexpr double kGravity = 9.81;      // [m/s^2]
constexpr std::int64_t kImuPeriod = 2'500'000;
// Standard deviations of a sample, those of the robot's IMU.
constexpr double kGyroNoise = 2.4e-3, kAccelNoise = 0.024;  // [rad/s], [m/s^2]

}  // namespace

JointRig::JointRig(const JointRigOptions& options) : options_(options) {}

void JointRig::enterInitializationMode(SimTime start) {
  *this = JointRig(options_);
  sensors_.time = sensors_.imu_time = start;
  sensors_.imu_count = 1;
  sampleImu();
}

void JointRig::sampleImu() {
  const auto index = static_cast<std::uint64_t>(sensors_.imu_count);
  const auto accel = accel_noise_.normals(index), gyro = gyro_noise_.normals(index);
  sensors_.accel_B = kGravity * up_B_ + Vector3(kAccelNoise * accel[0], kAccelNoise * accel[1], 0);
  sensors_.gyro_WB_B << kGyroNoise * gyro[0], kGyroNoise * gyro[1], kGyroNoise * gyro[2];
  sensors_.gyro_WB_B += Vector3(hands_.base_rate.data());
}

// The vertical stands still in the world, so it turns the other way in the base.
void JointRig::turnBase(double dt) {
  const Vector3 rate(hands_.base_rate.data());
  const double angle = rate.norm() * dt;
  if (angle == 0) return;
  up_B_ = Eigen::AngleAxisd(-angle, rate.normalized()) * up_B_;
}

// Torque by the exact solution for a constant command; the joint by small explicit steps.
void JointRig::advance(double dt, const JointVector& command) {
  const double w = kTwoPi * options_.bandwidth_Hz, d = options_.damping_ratio;
  while (dt > 1e-12) {
    const double h = std::min(dt, kLongestStep);
    dt -= h;
    for (int i = 0; i < kJointCount; ++i) {
      const double x = torque_[i] - command[i], v = torque_rate_[i], a = d * w;
      // x'' + 2 a x' + w^2 x = 0; s and c stand for sin/w_d and cos, or sinh and cosh.
      const double disc = w * w - a * a, wd = std::sqrt(std::abs(disc));
      const double s = wd * h < 1e-9 ? h
                       : disc > 0    ? std::sin(wd * h) / wd
                                     : std::sinh(wd * h) / wd;
      const double c = disc > 0 ? std::cos(wd * h) : std::cosh(wd * h);
      const double e = std::exp(-a * h);
      torque_[i] = command[i] + e * (x * (c + a * s) + v * s);
      torque_rate_[i] = e * (v * (c - a * s) - x * w * w * s);
      if (i == hands_.joint) velocity_[i] = hands_.joint_velocity;
      if (i == hands_.joint) angle_[i] += h * velocity_[i];
      if (options_.blocked || i == hands_.joint) continue;
      velocity_[i] += h / kInertia * (torque_[i] - kFriction * velocity_[i]);
      angle_[i] += h * velocity_[i];
    }
  }
}

void JointRig::doStep(SimTime now, SimDuration step, const ActuatorCommand& c) {
  const JointVector wanted = pdTorque(c, angle_, velocity_);
  double t = toSeconds(now);
  const double end = toSeconds(now + step);
  on_the_way_.emplace_back(t + options_.delay_s, wanted);
  while (!on_the_way_.empty() && on_the_way_.front().first < end - 1e-12) {
    const double at = std::max(t, on_the_way_.front().first);
    advance(at - t, acting_);
    t = at;
    acting_ = on_the_way_.front().second;
    on_the_way_.erase(on_the_way_.begin());
  }
  advance(end - t, acting_);
  turnBase(toSeconds(step));

  SensorFrame& s = sensors_;
  s.time = now + step;
  s.joint_angle = angle_;
  s.joint_velocity = velocity_;
  s.joint_torque = torque_;
  s.motor_angle = angle_ + torque_ / kSpring;
  const std::int64_t samples = toNs(s.time) / kImuPeriod + 1;
  if (samples == s.imu_count) return;
  s.imu_time = s.time;
  s.imu_count = samples;
  sampleImu();
}

StateBlob JointRig::saveState() const {
  throw CallOrderError("any", "saveState", "rig: the state of a test rig is not saved");
}
void JointRig::restoreState(const StateBlob&) { saveState(); }

std::uint64_t JointRig::stateDigest() const {
  Digest digest;
  for (const JointVector* v : {&torque_, &torque_rate_, &angle_, &velocity_, &acting_}) {
    digest.add(v->data(), sizeof(double) * kJointCount);
  }
  return digest.low64();
}

}  // namespace ballbot
