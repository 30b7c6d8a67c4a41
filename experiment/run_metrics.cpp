#include "experiment/run_metrics.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "plant/added_truth.hpp"

namespace ballbot {
namespace {

std::vector<PushMetrics::Interval> pushIntervals(const RunConfig& config) {
  const Matrix3 to_home = config.home.R_WH().transpose();
  std::vector<PushMetrics::Interval> out;
  for (const Push& push : config.plant.plant.pushes) {
    out.push_back({push.start, push.end(), (to_home * push.force_W).head<2>()});
  }
  return out;
}

ContactMetrics contactMetrics(const RunConfig& config) {
  const auto& door = config.plant.plant.surroundings.door;
  // As it is, not as it is believed to be.
  const RobotParameters& robot = config.plant.plant.robot;
  if (!door) return ContactMetrics(robot);
  return ContactMetrics(robot, door->opening_limit);
}

RobotLimits limitsOf(const RunConfig& config) {
  const RobotParameters& robot = config.believedRobot();
  const Constraints c = config.controller.law->limits();
  ArmVector lower, upper;  // the stops themselves: plans keep a margin from them
  for (int i = 0; i < kArmJointCount; ++i) {
    lower[i] = robot.arm[i].lower_limit;
    upper[i] = robot.arm[i].upper_limit;
  }
  return {robot.wheel_torque_limit,
          robot.arm_torque_limit,
          lower,
          upper,
          c.arm_rate_limit,
          c.tilt_limit};
}

}  // namespace

RunMetrics::RunMetrics(const RunConfig& config)
    : reference_(config.reference()),
      home_(config.home),
      balance_(config.scenario.release),
      push_(pushIntervals(config), config.scenario.release),
      tracking_(config.scenario.release),
      margins_(limitsOf(config), config.scenario.release),
      steps_(reference_->eeSteps(), config.scenario.release, kSimStart + config.scenario.duration),
      contact_(contactMetrics(config)),
      estimation_(config.scenario.release),
      spin_(config.scenario.release),
      wheels_(config.scenario.release, config.plant.plant.wheel_contact.friction),
      places_(AddedTruth::placesOf(AddedTruth(config.plant.plant).signals())) {}

void RunMetrics::add(const Tick& tick) {
  if (!tick.truth) return;
  const ControlOutput& control = tick.control;
  const TruthFrame truth = home_.see(*tick.truth);
  const PlaceReference place = reference_->place(truth.time);
  balance_.add(truth, control.command);
  push_.add(truth, place);
  margins_.add(truth, control.command);
  tracking_.add(truth, place);
  steps_.add(truth, reference_->eePose(truth.time));
  contact_.add(truth, control.plan.contact_asked_W, control.estimate.contact_force_W);
  if (const AddedSignals* added = tick.added[AddedTo::kTruth];
      added != nullptr && !added->empty()) {
    addBesideTruth(truth.time, *added);
  }
  if (!control.has_estimate) return;
  estimation_.add(truth, control.estimate.state);
  if (control.has_self_assessment) estimation_.addConsistency(control.self_assessment);
}

void RunMetrics::addBesideTruth(SimTime now, const AddedSignals& added) {
  std::array<double, AddedTruth::kPlaces> v;
  v.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < places_.size(); ++i) v[places_[i]] = added.values[i];
  if (!std::isnan(v[AddedTruth::kSpinRate])) {
    spin_.add(now, v[AddedTruth::kSpinRate], v[AddedTruth::kSpinTorque],
              v[AddedTruth::kSpinTorqueHeld]);
  }
  const auto ofWheels = [&](AddedTruth::Place first) -> Vector3 {
    return Eigen::Map<const Vector3>(&v[first]);
  };
  if (!std::isnan(v[AddedTruth::kNormalForce])) {
    wheels_.add(now, ofWheels(AddedTruth::kNormalForce), ofWheels(AddedTruth::kTraction),
                ofWheels(AddedTruth::kSlip));
  }
}

std::map<std::string, double> RunMetrics::values() const {
  std::map<std::string, double> all = balance_.values();
  all.merge(push_.values());
  all.merge(tracking_.values());
  all.merge(margins_.values());
  all.merge(steps_.values());
  all.merge(contact_.values());
  all.merge(estimation_.values());
  all.merge(spin_.values());
  all.merge(wheels_.values());
  return all;
}

std::vector<std::string> RunMetrics::names() {
  std::vector<std::string> all;
  for (const auto& names :
       {BalanceMetrics::names(), PushMetrics::names(), EeStepMetrics::names(),
        ContactMetrics::names(), TrackingMetrics::names(), LimitMargins::names(),
        EstimationErrors::names(), SpinMetrics::names(), WheelMetrics::names()}) {
    all.insert(all.end(), names.begin(), names.end());
  }
  return all;
}

}  // namespace ballbot
