#include "estimator/arm_sensing.hpp"

#include <cmath>

namespace ballbot {

void ArmSensing::update(const SensorFrame& frame) noexcept {
  const ArmVector angle = frame.joint_angle.tail<kArmJointCount>();
  const ArmVector rate = frame.joint_velocity.tail<kArmJointCount>();
  if (!angle.allFinite() || !rate.allFinite()) return;
  if (!started_ || time_constant_s_ <= 0) {
    rate_ = rate;
  } else {
    // Exact for a rate that is constant between the samples.
    const double keep = std::exp(-toSeconds(frame.time - time_) / time_constant_s_);
    rate_ = keep * rate_ + (1 - keep) * rate;
  }
  angle_ = angle;
  time_ = frame.time;
  started_ = true;
}

void ArmSensing::writeTo(SimTime now, StateVector& x) const noexcept {
  x.segment<kArmJointCount>(kArm1) = angle_;
  if (started_) x.segment<kArmJointCount>(kArm1) += toSeconds(now - time_) * rate_;
  x.segment<kArmJointCount>(kPositionDim + kArmRate1) = rate_;
}

}  // namespace ballbot
