#include "estimator/complementary_observer.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/config_visitor.hpp"
#include "core/state_visitors.hpp"
#include "estimator/attitude.hpp"
#include "estimator/delay_compensation.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

constexpr const char* kBlobKind = "complementary_observer";
constexpr std::uint32_t kBlobVersion = 3;
constexpr double kSpinTimeConstant = 0.1;  // [s]

}  // namespace

void ComplementarySettings::describe(ConfigVisitor& v) {
  describeOwn(v);
  SharedSettings::describe(v);
}

void ComplementarySettings::describeOwn(ConfigVisitor& v) {
  v.number(may("velocity_bandwidth_rad_per_s",
               "below it odometry decides about the velocity, above it the accelerometer"),
           velocity_bandwidth_rad_per_s, {0.1, 200});
  v.number(may("tilt_bandwidth_rad_per_s",
               "below it gravity decides about the tilt, above it the gyroscope"),
           tilt_bandwidth_rad_per_s, {0, 20});
  v.number(may("gyro_bias_time_constant_s", "how slowly the gyroscope's bias follows"),
           gyro_bias_time_constant_s, {1, 1e6});
  v.number(may("velocity_innovation_limit_m_per_s",
               "a larger difference between odometry and predicted velocity counts as this much"),
           velocity_innovation_limit_m_per_s, {1e-3, 10});
  v.number(may("spin_limit_rad_per_s",
               "spin found by odometry, mean over 0.1 s, above which it is no gyroscope bias"),
           spin_limit_rad_per_s, {1e-3, 1e6});
}

ComplementarySettings ComplementarySettings::read(ConfigReader& in) {
  ComplementarySettings s;
  readDescribed(in, s);
  return s;
}

ComplementaryObserver::ComplementaryObserver(const RobotParameters& robot,
                                             const ComplementarySettings& settings)
    : settings_(settings),
      kinematics_(robot),
      ball_radius_(robot.ball.radius),
      gravity_(robot.gravity),
      p_BI_B_(robot.p_BI_B),
      arm_(settings.arm_rate_time_constant_s) {}

bool ComplementaryObserver::update(const SensorFrame& frame, bool at_rest) noexcept {
  const FrameTime when = order_.judge(frame.time);
  if (when == FrameTime::kLate || when == FrameTime::kAhead) return false;
  arm_.update(frame);
  if (!frame.joint_angle.allFinite()) return true;
  joints_.add(frame.time, frame.joint_angle);
  if (when == FrameTime::kLeap) {  // nothing is known of what was in between
    time_ = frame.time;
    joint_angle_ = frame.joint_angle;
  }
  released_ = released_ || !at_rest;
  if (frame.imu_count != imu_count_) takeImu(frame);
  return true;
}

void ComplementaryObserver::takeImu(const SensorFrame& frame) noexcept {
  imu_count_ = frame.imu_count;
  if (!frame.accel_B.allFinite() || !frame.gyro_WB_B.allFinite()) return;
  if (frame.imu_time > frame.time) return;
  if (released_ && alignment_.samples() > 0) {
    if (frame.imu_time > time_) step(frame);
  } else {
    align(frame);
  }
}

void ComplementaryObserver::align(const SensorFrame& frame) noexcept {
  // Without any rest the first sample serves as well as it can; the estimate then is not aligned.
  alignment_.add(frame.accel_B, released_ ? Vector3::Zero() : frame.gyro_WB_B);
  x_.R_WB = alignment_.attitude();
  x_.gyro_bias = alignment_.gyroBias();
  time_ = frame.imu_time;
  joint_angle_ = joints_.at(time_);
}

void ComplementaryObserver::step(const SensorFrame& frame) noexcept {
  const double h = toSeconds(frame.imu_time - time_);
  const Vector3 w = frame.gyro_WB_B - x_.gyro_bias;
  const Matrix3 R_mid = x_.R_WB * expSO3(0.5 * h * w);
  const Matrix3 R_gyro = x_.R_WB * expSO3(h * w);

  // Specific force moves the IMU; the lever arm's part is taken out by its increment.
  const Vector3 dv_imu = h * (R_mid * frame.accel_B - gravity_ * Vector3::UnitZ());
  const Vector3 dv_lever = R_gyro * w.cross(p_BI_B_) - x_.R_WB * x_.w_WB_B.cross(p_BI_B_);
  const Eigen::Vector2d predicted = x_.v_WK_W + (dv_imu - dv_lever).head<2>();

  const JointVector angle = joints_.at(frame.imu_time);
  const Vector3 wheel_rates = (angle - joint_angle_).head<kWheelCount>() / h;
  const BallMotion odometry = ballMotion(kinematics_, ball_radius_, R_mid, wheel_rates, w);

  // Gains place the poles of (velocity, tilt) at the two bandwidths.
  const double p1 = settings_.velocity_bandwidth_rad_per_s;
  const double p2 = settings_.tilt_bandwidth_rad_per_s;
  Eigen::Vector2d innovation = odometry.velocity_W - 0.5 * (x_.v_WK_W + predicted);
  const double limit = settings_.velocity_innovation_limit_m_per_s;
  if (innovation.norm() > limit) innovation *= limit / innovation.norm();
  // A tilt error d (rotation vector in W) shows as an acceleration g (dy, -dx).
  const Vector3 tilt_rate_W = p1 * p2 / gravity_ * Vector3(-innovation.y(), innovation.x(), 0.0);

  x_.p_WK_W += h * odometry.velocity_W;
  x_.R_WB = orthonormalized(expSO3(h * tilt_rate_W) * R_gyro);
  x_.v_WK_W = predicted + std::min(1.0, (p1 + p2) * h) * innovation;
  x_.w_WB_B = w;
  const double bias_gain = std::min(1.0, h / settings_.gyro_bias_time_constant_s);
  spin_ += std::min(1.0, h / kSpinTimeConstant) * (odometry.spin - spin_);
  const double spin = std::abs(spin_) > settings_.spin_limit_rad_per_s ? 0.0 : odometry.spin;
  x_.gyro_bias += bias_gain * (x_.R_WB.transpose() * (spin * Vector3::UnitZ() - tilt_rate_W));
  yaw_ = unwrapped(yawPitchRollFromRotation(x_.R_WB)[0], yaw_);
  joint_angle_ = angle;
  time_ = frame.imu_time;
}

StateEstimate ComplementaryObserver::estimate(SimTime now) const noexcept {
  StateEstimate out;
  out.time = now;
  out.aligned = alignment_.samples() >= settings_.alignment_samples;
  out.x = bringForward(x_, Eigen::Vector2d::Zero(), yaw_, now - time_);
  arm_.writeTo(now, out.x);
  return out;
}

StateBlob ComplementaryObserver::saveState() const {
  return saveStateOf(*this, kBlobKind, kBlobVersion);
}

void ComplementaryObserver::restoreState(const StateBlob& blob) {
  restoreStateOf(*this, blob, kBlobKind, kBlobVersion);
}

}  // namespace ballbot
