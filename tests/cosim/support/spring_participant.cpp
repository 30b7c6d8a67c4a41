#include "tests/cosim/support/spring_participant.hpp"

#include <limits>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "core/state_visitors.hpp"

namespace ballbot::testing_support {

void SpringParticipant::enterInitializationMode(SimTime start) {
  time_ = start;
  for (int i = 0; i < kJointCount; ++i) position_[i] = 0.1 * (i + 1);
}

// Semi-implicit Euler of x'' = -40 x - 0.5 x' + tau, at the communication step.
void SpringParticipant::doStep(SimTime now, SimDuration step, const ActuatorCommand& command) {
  if (now + step >= fail_at_) throw NumericalError("spring: broke at " + toText(fail_at_));
  const double h = toSeconds(step);
  const JointVector drive = command.torque +
                            command.stiffness.cwiseProduct(command.position - position_) +
                            command.damping.cwiseProduct(command.velocity - velocity_);
  velocity_ += h * (-40.0 * position_ - 0.5 * velocity_ + drive);
  position_ += h * velocity_;
  time_ = now + step;
  ++steps_;
  measure();
}

void SpringParticipant::measure() {
  const std::array<double, 4> noise = noise_.normals(static_cast<std::uint64_t>(steps_));
  sensors_.time = time_;
  sensors_.joint_angle = position_;
  sensors_.joint_angle[0] += 1e-3 * noise[0];
  sensors_.motor_angle = position_;
  sensors_.joint_velocity = velocity_;
  sensors_.imu_count = steps_;
  sensors_.imu_time = time_;
  sensors_.accel_B = {0, 0, 9.81};
  sensors_.gyro_WB_B = velocity_.head<3>();
  if (time_ >= nan_from_) sensors_.gyro_WB_B[1] = std::numeric_limits<double>::quiet_NaN();
}

std::optional<TruthFrame> SpringParticipant::truth() const {
  if (!knows_truth_) return std::nullopt;
  TruthFrame truth;
  truth.time = time_;
  truth.joint_angle = position_;
  truth.joint_velocity = velocity_;
  return truth;
}

StateBlob SpringParticipant::saveState() const { return saveStateOf(*this, "spring", 1); }

void SpringParticipant::restoreState(const StateBlob& blob) {
  restoreStateOf(*this, blob, "spring", 1);
  measure();
}

std::uint64_t SpringParticipant::stateDigest() const {
  Digest digest;
  digest.add(toNs(time_));
  digest.add(position_.data(), sizeof(double) * kJointCount);
  digest.add(velocity_.data(), sizeof(double) * kJointCount);
  return digest.low64();
}

}  // namespace ballbot::testing_support
