#include "experiment/robot_sensing.hpp"

#include "core/config_reader.hpp"
#include "estimator/estimator_factory.hpp"
#include "experiment/believed_robot.hpp"
#include "messages/convert.hpp"

namespace ballbot {
namespace {

/// Of the contact force observer: slower than the arm's rate noise, faster than a slip [rad/s].
constexpr double kContactForceBandwidth = 25;

}  // namespace

RobotSensing::RobotSensing(const Scenario& scenario)
    : release_(scenario.release), contact_force_(believedRobot(scenario), kContactForceBandwidth) {
  ConfigReader in(scenario.section("estimator"), "estimator");
  estimator_ = makeEstimator(in, scenarioRobot(scenario));
}

void RobotSensing::update(const SensorFrame& frame) noexcept {
  const bool held = frame.time < release_;
  estimator_->update(frame, held);
  if (held) {
    contact_force_.reset();  // the stand holds the arm, too
  } else {
    contact_force_.update(frame.time, estimator_->estimate(frame.time).x, frame.joint_torque);
  }
}

void RobotSensing::write(SimTime now, ballbot_msgs::state_estimate& out) const noexcept {
  const StateEstimate e = estimator_->estimate(now);
  toMessage(now, e.x, e.sigma, e.aligned, out);
  Eigen::Map<Vector3>{out.contact_force_W} = contact_force_.force();
}

void RobotSensing::save(BlobWriter& out) const {
  out.putBlob(estimator_->saveState());
  contact_force_.save(out);
}

void RobotSensing::restore(BlobReader& in) {
  estimator_->restoreState(in.getBlob());
  contact_force_.restore(in);
}

}  // namespace ballbot
