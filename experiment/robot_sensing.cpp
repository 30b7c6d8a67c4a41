#include "experiment/robot_sensing.hpp"

namespace ballbot {
namespace {

/// Of the contact force observer: slower than the arm's rate noise, faster than a slip [rad/s].
constexpr double kContactForceBandwidth = 25;

}  // namespace

RobotSensing::RobotSensing(const RunConfig& config)
    : release_(config.scenario.release),
      estimator_(config.estimator->make(config.believedRobot())),
      contact_force_(config.believedRobot(), kContactForceBandwidth),
      lasting_(config.controller.offset_free) {}

void RobotSensing::update(const SensorFrame& frame) noexcept {
  const bool held = frame.time < release_;
  if (!estimator_->update(frame, held)) return;
  if (held) {
    contact_force_.reset();  // the stand holds the arm, too
    lasting_.reset();
  } else {
    contact_force_.update(frame.time, estimator_->estimate(frame.time).x, frame.joint_torque);
    lasting_.update(frame.time, contact_force_.residual(), false);
  }
}

StateEstimate RobotSensing::write(SimTime now, EstimateFrame& out) const noexcept {
  const StateEstimate e = estimator_->estimate(now);
  out.time = now;
  out.state = e.x;
  out.sigma = e.sigma;
  out.contact_force_W = contact_force_.force();
  out.aligned = e.aligned;
  return e;
}

void RobotSensing::restore(const State& state) {
  estimator_->restoreState(state.estimator);
  contact_force_ = state.contact_force;
  lasting_ = state.lasting;
}

}  // namespace ballbot
