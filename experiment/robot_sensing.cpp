#include "experiment/robot_sensing.hpp"

#include <cmath>

namespace ballbot {
namespace {

/// Of the contact force observer: slower than the arm's rate noise, faster than a slip [rad/s].
constexpr double kContactForceBandwidth = 25;

/// A ball that spins about the vertical faster than creep [rad/s].
constexpr double kSpins = 0.15;

std::int64_t wheelsRefused(const RejectionCounts& counts) {
  std::int64_t sum = counts[Rejection::kStateDoubted];
  for (const Rejection first :
       {Rejection::kWheel1Outlier, Rejection::kWheel1Slip, Rejection::kWheel1Stuck}) {
    for (int i = 0; i < kWheelCount; ++i) {
      sum += counts[static_cast<Rejection>(static_cast<int>(first) + i)];
    }
  }
  return sum;
}

}  // namespace

RobotSensing::RobotSensing(const RunConfig& config)
    : release_(config.scenario.release),
      estimator_(config.estimator->make(config.believedRobot())),
      contact_force_(config.believedRobot(), kContactForceBandwidth),
      lasting_(config.believedRobot(), config.controller.offset_free) {}

void RobotSensing::update(const SensorFrame& frame) noexcept {
  const bool held = frame.time < release_;
  if (!estimator_->update(frame, held)) return;
  if (held) {
    contact_force_.reset();  // the stand holds the arm, too
    lasting_.reset();
    if (lasting_.enabled()) tellHand();
  } else {
    const StateEstimate e = estimator_->estimate(frame.time);
    contact_force_.update(frame.time, e.x, frame.joint_torque);
    if (lasting_.enabled()) learnLasting(frame, e);
  }
}

void RobotSensing::learnLasting(const SensorFrame& frame, const StateEstimate& e) noexcept {
  const std::int64_t refused = wheelsRefused(estimator_->rejections());
  const bool slips = refused != wheels_refused_;
  wheels_refused_ = refused;
  lasting_.update(frame.time, {contact_force_.residual(), contact_force_.force(),
                               slips || std::abs(e.spin_rate) > kSpins});
  tellHand();
}

void RobotSensing::tellHand() noexcept {
  contact_force_.setPayload(lasting_.handMass());
  estimator_->setHand(lasting_.handMass(), lasting_.handKnown());
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
  wheels_refused_ = state.wheels_refused;
  if (lasting_.enabled()) tellHand();
}

}  // namespace ballbot
