#include "controller/mpc_execution.hpp"

#include <cmath>

namespace ballbot {

MpcExecution::MpcExecution(const RobotParameters& robot, const MpcConfig& config)
    : fallback_after_(config.fallback_after), shaping_(config.shaping), lqr_(robot, config.lqr) {}

bool MpcExecution::inForce(const MpcPolicy& active, SimTime now) const noexcept {
  return active.valid() && now - active.stamp() <= fallback_after_;
}

bool MpcExecution::fellBack(const MpcPolicy& active, bool refused, SimTime now) const noexcept {
  return (active.valid() || refused) && !inForce(active, now);
}

PolicySample MpcExecution::planStandIn(const MpcPolicy& active, bool refused, SimTime now,
                                       const StateVector& x,
                                       const JointVector& joint_angle) noexcept {
  if (x.allFinite() && !fellBack(active, refused, now)) {
    lqr_.setGroundSetPoint(x.segment<2>(kBallX), x[kYaw]);
  }
  PolicySample stand_in;
  lqr_.plan(now, x, joint_angle);
  lqr_.samplePlan(now, stand_in);
  return stand_in;
}

void MpcExecution::sample(const MpcPolicy& active, SimTime now, PolicySample& out) const noexcept {
  const bool planned = inForce(active, now);
  if (planned) {
    active.sample(now, xf_, out);
  } else {
    lqr_.sample(now, out);
  }
  out.from_stand_in = !planned;
}

void MpcExecution::commanded(SimDuration period, const JointVector& torque) noexcept {
  const double a = std::exp(-shaping_.pole * toSeconds(period));
  xf_ = a * xf_ + (1 - a) * torque.head<kWheelCount>();
}

void MpcExecution::restore(const Vector3& filter_state, const StateBlob& stand_in) {
  lqr_.restoreState(stand_in);
  xf_ = filter_state;
}

}  // namespace ballbot
