#include "experiment/robot_sensing.hpp"

#include <fmt/format.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "estimator/estimator_factory.hpp"
#include "experiment/believed_robot.hpp"

namespace ballbot {
namespace {

/// Of the contact force observer: slower than the arm's rate noise, faster than a slip [rad/s].
constexpr double kContactForceBandwidth = 25;

/// The estimator sees one sensor frame per period. Of an IMU that is faster it would see only the
/// last sample of each, and take those in between for lost.
void requireEveryImuSample(const Scenario& scenario) {
  ConfigReader robot(scenario.section("robot"), "robot");
  if (!robot.has("sensors")) return;
  ConfigReader imu = robot.child("sensors").child("imu");
  const SimDuration period = imu.duration("period_ms"), estimator = scenario.rates.estimator;
  if (period >= estimator) return;
  throw InputError(fmt::format(
      "{} is {}, but the estimator looks once in {}, and would never see {:.0f} % of the samples. Set "
      "rates.estimator_period_us: {:g}, or the IMU to a period of {} or longer",
      imu.at("period_ms"), toText(period), toText(estimator),
      100 * (1 - toSeconds(period) / toSeconds(estimator)), 1e6 * toSeconds(period),
      toText(estimator)));
}

}  // namespace

RobotSensing::RobotSensing(const Scenario& scenario)
    : release_(scenario.release), contact_force_(believedRobot(scenario), kContactForceBandwidth) {
  requireEveryImuSample(scenario);
  ConfigReader in(scenario.section("estimator"), "estimator");
  estimator_ = makeEstimator(in, believedRobot(scenario));
}

void RobotSensing::update(const SensorFrame& frame) noexcept {
  const bool held = frame.time < release_;
  if (!estimator_->update(frame, held)) return;
  if (held) {
    contact_force_.reset();  // the stand holds the arm, too
  } else {
    contact_force_.update(frame.time, estimator_->estimate(frame.time).x, frame.joint_torque);
  }
}

void RobotSensing::write(SimTime now, EstimateFrame& out) const noexcept {
  const StateEstimate e = estimator_->estimate(now);
  out.time = now;
  out.state = e.x;
  out.sigma = e.sigma;
  out.contact_force_W = contact_force_.force();
  out.aligned = e.aligned;
}

void RobotSensing::restore(const State& state) {
  estimator_->restoreState(state.estimator);
  contact_force_ = state.contact_force;
}

}  // namespace ballbot
