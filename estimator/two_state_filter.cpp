#include "estimator/two_state_filter.hpp"

#include <algorithm>

#include "core/state_visitors.hpp"
#include "estimator/attitude.hpp"
#include "estimator/delay_compensation.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

template <int kDim>
constexpr const char* kBlobKind = kDim > kTanSpin ? "two_state_spin_filter" : "two_state_filter";
constexpr std::uint32_t kBlobVersion = 5;
/// Of an IMU: a counter that jumps must not make a millisecond a thousand intervals.
constexpr SimDuration kShortestPeriod{100'000};
constexpr double kLargestYawSigma = 0.1;  // [rad]
constexpr double kSpinInMotion = 1.0;     // [rad/s]
constexpr double kSpinLoadTime_s = 0.01;  // over which the load under a ball is averaged

/// Together with a spin of which nothing else tells, one standard deviation [rad/s].
template <int kDim>
BasicTangentMatrix<kDim> withSpin(const TangentMatrix& information, double sigma) {
  BasicTangentMatrix<kDim> out = BasicTangentMatrix<kDim>::Zero();
  out.template topLeftCorner<kTangentDim, kTangentDim>() = information;
  if constexpr (kDim > kTanSpin) out(kTanSpin, kTanSpin) = 1 / (sigma * sigma);
  return out;
}

}  // namespace

template <int kDim>
BasicTwoStateFilter<kDim>::BasicTwoStateFilter(const RobotParameters& robot,
                                               const TwoStateSettings& settings)
    : settings_(settings),
      gravity_(robot.gravity),
      wheels_(robot),
      arm_(settings.arm_rate_time_constant_s),
      filter_(robot, settings.noise, settings.gate, settings.initial.accel_bias,
              settings.iterations, settings.spin),
      accel_gate_(settings.gate.accel_jump_m_per_s2),
      gyro_gate_(settings.gate.gyro_jump_rad_per_s),
      poses_(settings.pose, settings.initial.yaw),
      balance_(robot, settings.balance) {
  // The filter is linear in yaw and would wander off in one that may be anywhere; turning about the
  // vertical changes nothing it measures, so it does not need to know.
  settings_.initial.yaw = std::min(settings_.initial.yaw, kLargestYawSigma);
  align(SensorFrame{});
}

template <int kDim>
bool BasicTwoStateFilter<kDim>::update(const SensorFrame& frame, bool at_rest) noexcept {
  switch (order_.judge(frame.time)) {
    case FrameTime::kNext:
      break;
    case FrameTime::kLate:
      counts_.add(Rejection::kFrameLate);
      return false;
    case FrameTime::kAhead:
      counts_.add(Rejection::kFrameAhead);
      return false;
    case FrameTime::kLeap:
      leapTo(frame.time);
      break;
  }
  arm_.update(frame);
  if (frame.joint_angle.allFinite()) {
    joints_.add(frame.time, frame.joint_angle);
  } else {
    counts_.add(Rejection::kNotFinite);
  }
  released_ = released_ || !at_rest;
  if (frame.imu_count != imu_count_) {
    imu_count_ = frame.imu_count;
    takeImu(frame);
  }
  // A sample that does not come must not hold up the filter.
  while (running_ && frame.time - time_ > imu_period_ + settings_.imu_wait) {
    stepTo(time_ + imu_period_, nullptr);
  }
  if (settings_.use_external_pose && frame.pose_count != pose_count_) {
    pose_count_ = frame.pose_count;
    if (running_) {
      poses_.take(frame, time_, filter_, yaw_, counts_);
    } else if (!released_) {
      poses_.takeAtRest(frame.pose_W, counts_);
    }
  }
  return true;
}

template <int kDim>
void BasicTwoStateFilter<kDim>::takeImu(const SensorFrame& frame) noexcept {
  if (!frame.accel_B.allFinite() || !frame.gyro_WB_B.allFinite()) {
    counts_.add(Rejection::kNotFinite);
    return;
  }
  if (frame.imu_time > frame.time + imu_period_) {
    counts_.add(Rejection::kImuAhead);
    return;
  }
  if (!running_) {
    if (!released_ || alignment_.samples() == 0) {
      const bool accel_ok = accel_gate_.accepts(frame.accel_B);
      const bool gyro_ok = gyro_gate_.accepts(frame.gyro_WB_B);
      if (!accel_ok) counts_.add(Rejection::kAccelSpike);
      if (!gyro_ok) counts_.add(Rejection::kGyroSpike);
      if (accel_ok && gyro_ok) align(frame);
    }
    if (!released_) return;
    release(frame);
    if (frame.imu_time <= time_) return;
  }
  if (frame.imu_time <= time_) {
    counts_.add(Rejection::kImuLate);
    return;
  }
  // The sample tells about the last period only; what is missing before it is gone through without.
  while (frame.imu_time - time_ > imu_period_ + imu_period_ / 2) {
    stepTo(time_ + imu_period_, nullptr);
  }
  stepTo(frame.imu_time, &frame);
}

template <int kDim>
void BasicTwoStateFilter<kDim>::align(const SensorFrame& frame) noexcept {
  if (frame.imu_count > 0) {
    if (alignment_.samples() == 0) {
      first_imu_count_ = frame.imu_count;
      first_imu_time_ = frame.imu_time;
    } else if (frame.imu_count > first_imu_count_ && frame.imu_time > first_imu_time_) {
      imu_period_ =
          std::max((frame.imu_time - first_imu_time_) / (frame.imu_count - first_imu_count_),
                   kShortestPeriod);
    }
    alignment_.add(frame.accel_B, frame.gyro_WB_B);
    time_ = frame.imu_time;
  }
  InitialEstimate initial = initialEstimate(alignment_, !released_, settings_.initial,
                                            settings_.noise, toSeconds(imu_period_), gravity_);
  placeAt(poses_.atRest(), settings_.pose, initial);
  yaw_ = unwrapped(poses_.atRest().mean()[2], yaw_);
  const double spin_sigma = released_ ? kSpinInMotion : settings_.spin.creep;
  filter_.initialise(initial.x, withSpin<kDim>(initial.information, spin_sigma));
}

template <int kDim>
void BasicTwoStateFilter<kDim>::leapTo(SimTime time) noexcept {
  if (!running_) return;
  counts_.add(Rejection::kStateDoubted);
  filter_.doubt();
  time_ = time;
  wheel_angle_known_ = false;
  balance_.interrupt();
  followYaw();
}

template <int kDim>
void BasicTwoStateFilter<kDim>::release(const SensorFrame& frame) noexcept {
  // Where samples were missing before the release, the robot stood.
  time_ = std::max(time_, frame.imu_time - imu_period_);
  FilterState x = filter_.state();
  const Vector3 ypr = yawPitchRollFromRotation(x.R_WB);
  x.R_WB =
      rotationFromYawPitchRoll(poses_.atRest().mean()[2], ypr[1] + settings_.initial_tilt_error[0],
                               ypr[2] + settings_.initial_tilt_error[1]);
  filter_.initialise(x, filter_.information());
  running_ = true;
  wheel_angle_known_ =
      !joints_.empty() && joints_.oldestTime() <= time_ && time_ <= joints_.newestTime();
  if (wheel_angle_known_) wheel_angle_ = joints_.at(time_).head<kWheelCount>();
  followYaw();
}

template <int kDim>
void BasicTwoStateFilter<kDim>::stepTo(SimTime time, const SensorFrame* imu) noexcept {
  IntervalMeasurement m;
  m.h = toSeconds(time - time_);
  if (imu == nullptr) {
    counts_.add(Rejection::kImuMissing);
  } else {
    m.accel_B = imu->accel_B;
    m.gyro_B = imu->gyro_WB_B;
    m.has_accel = accel_gate_.accepts(m.accel_B);
    m.has_gyro = gyro_gate_.accepts(m.gyro_B);
    if (!m.has_accel) counts_.add(Rejection::kAccelSpike);
    if (!m.has_gyro) counts_.add(Rejection::kGyroSpike);
  }
  const bool known =
      !joints_.empty() && joints_.oldestTime() <= time && time <= joints_.newestTime();
  const Vector3 angle = known ? Vector3(joints_.at(time).head<kWheelCount>()) : wheel_angle_;
  if (known && wheel_angle_known_) {
    m.has_wheel.fill(true);
    m.wheel_increment = angle - wheel_angle_;
  }
  wheel_angle_ = angle;
  wheel_angle_known_ = known;

  if constexpr (kSpins) {
    if (imu != nullptr) followSpinLoad(m.h, imu->joint_torque);
    m.spin_load = spin_load_;
  }
  filter_.step(m, counts_);
  time_ = time;
  if (m.has_gyro && known) {
    balance_.step(m.h, time, joints_, filter_);
  } else {
    balance_.interrupt();
  }
  followYaw();
}

template <int kDim>
void BasicTwoStateFilter<kDim>::followSpinLoad(double h, const JointVector& joint_torque) noexcept {
  const Vector3 wheels = joint_torque.head<kWheelCount>();
  if (!wheels.allFinite()) return;
  const Vector3 up_B = filter_.state().R_WB.row(2);
  const double load = up_B.dot(wheels_.ballTorque(wheels));
  spin_load_ += std::min(1.0, h / kSpinLoadTime_s) * (load - spin_load_);
}

template <int kDim>
void BasicTwoStateFilter<kDim>::followYaw() noexcept {
  yaw_ = unwrapped(yawPitchRollFromRotation(filter_.state().R_WB)[0], yaw_);
  poses_.tell(time_, filter_.state(), yaw_);
}

template <int kDim>
StateEstimate BasicTwoStateFilter<kDim>::estimate(SimTime now) const noexcept {
  const FilterState& x = filter_.state();
  StateEstimate out;
  out.time = now;
  out.aligned = alignment_.samples() >= settings_.alignment_samples;
  const SimDuration ahead = running_ ? std::max(now - time_, SimDuration{0}) : SimDuration{0};
  out.x = bringForward(x, filter_.acceleration(), yaw_, ahead);
  arm_.writeTo(now, out.x);

  // Of the covariance C C' only the diagonal is wanted, for the attitude about the axes of W.
  const BasicTangentMatrix<kDim>& C = filter_.covarianceRoot();
  out.sigma << C.template middleRows<2>(kTanPosition).rowwise().norm(),
      (x.R_WB * C.template middleRows<3>(kTanAttitude)).rowwise().norm(),
      C.template middleRows<5>(kTanVelocity).rowwise().norm();
  if constexpr (kSpins) {
    out.spin_rate = x.spin;
    out.spin_rate_sigma = C.row(kTanSpin).norm();
  }
  return out;
}

template <int kDim>
std::optional<SelfAssessment> BasicTwoStateFilter<kDim>::selfAssessment() const noexcept {
  if (!running_) return std::nullopt;
  const FilterState& x = filter_.state();
  const BasicTangentMatrix<kDim>& C = filter_.covarianceRoot();
  Eigen::Matrix<double, 4, kDim> root;
  root << x.R_WB.template topRows<2>() * C.template middleRows<3>(kTanAttitude),
      C.template middleRows<2>(kTanVelocity);
  SelfAssessment out;
  out.time = time_;
  out.tilt_velocity_covariance = root * root.transpose();
  out.nis = filter_.nis();
  out.nis_degrees = filter_.nisDegrees();
  out.accel_bias = x.accel_bias;
  out.gyro_bias = x.gyro_bias;
  return out;
}

template <int kDim>
StateBlob BasicTwoStateFilter<kDim>::saveState() const {
  return saveStateOf(*this, kBlobKind<kDim>, kBlobVersion);
}

template <int kDim>
void BasicTwoStateFilter<kDim>::restoreState(const StateBlob& blob) {
  restoreStateOf(*this, blob, kBlobKind<kDim>, kBlobVersion);
}

template class BasicTwoStateFilter<kTangentDim>;
template class BasicTwoStateFilter<kSpinTangentDim>;

}  // namespace ballbot
