#include "controller/mpc_policy.hpp"

#include "solver/between_samples.hpp"

namespace ballbot {

MpcState MpcPolicy::stateAt(double t) const noexcept {
  return BetweenSamples<Knot>(knots_, t).of(&Knot::x);
}

void MpcPolicy::controlAt(double t, MpcInput& u, MpcGain& K) const noexcept {
  const BetweenSamples<Control> between(controls_, t);
  u = between.of(&Control::u);
  K = between.of(&Control::K);
}

void MpcPolicy::sample(SimTime now, const Vector3& xf, PolicySample& out) const noexcept {
  const double t = toSeconds(now - stamp_);
  const BetweenSamples<Knot> knot(knots_, t);
  const BetweenSamples<Control> control(controls_, t);
  const MpcState x = knot.of(&Knot::x);
  out.x = x.head<kStateDim>();
  out.joint_position = knot.of(&Knot::joint_position);
  out.joint_velocity = knot.of(&Knot::joint_velocity);
  const MpcGain K = control.of(&Control::K);
  out.torque = control.of(&Control::u).head<kJointCount>();
  out.torque.noalias() += K.topRightCorner<kJointCount, kFilterDim>() * (xf - x.tail<kFilterDim>());
  out.feedback = K.topLeftCorner<kJointCount, kStateDim>();
}

void MpcPolicy::integrateJoints(const ReducedDynamics& dynamics,
                                const JointVector& joint_angle) noexcept {
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    Knot& knot = knots_[k];
    knot.joint_velocity = dynamics.selectionMatrix(knot.x.head<kPositionDim>()) *
                          knot.x.segment<kVelocityDim>(kPositionDim);
    if (k == 0) {
      knot.joint_position = joint_angle;
    } else {
      const Knot& last = knots_[k - 1];
      knot.joint_position = last.joint_position + 0.5 * (knot.time - last.time) *
                                                      (last.joint_velocity + knot.joint_velocity);
    }
    knot.joint_position.tail<kArmJointCount>() = knot.x.segment<kArmJointCount>(kArm1);
  }
}

}  // namespace ballbot
