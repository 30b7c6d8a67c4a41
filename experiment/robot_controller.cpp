#include "experiment/robot_controller.hpp"

#include "controller/law_factory.hpp"
#include "controller/policy_sample_blob.hpp"
#include "core/config_reader.hpp"
#include "estimator/estimator_factory.hpp"
#include "experiment/rejection_metrics.hpp"
#include "messages/convert.hpp"
#include "model/robot_reader.hpp"

namespace ballbot {
namespace {

/// Of the contact force observer: slower than the arm's rate noise, faster than a slip [rad/s].
constexpr double kContactForceBandwidth = 25;

}  // namespace

RobotController::RobotController(const Scenario& scenario, EventCalendar& calendar)
    : release_(scenario.release),
      tracker_period_(scenario.rates.tracker),
      plan_latency_(scenario.rates.plan_latency) {
  ConfigReader robot_in(scenario.section("robot"), "robot");
  const RobotParameters robot = readRobot(robot_in);

  ConfigReader estimator_in(scenario.section("estimator"), "estimator");
  estimator_ = makeEstimator(estimator_in, robot);

  // What the controller believes it carries; what it does carry stands in `environment`.
  ConfigReader in(scenario.section("controller"), "controller");
  RobotParameters believed = robot;
  believed.payload_mass = in.numberOr("known_payload_kg", robot.payload_mass, {0, 5});
  law_ = makeControlLaw(in, believed);
  contact_force_ = std::make_unique<ContactForceObserver>(believed, kContactForceBandwidth);
  ConfigReader tracker_in = in.child("tracker");
  tracker_ = std::make_unique<PdTracker>(TrackerConfig::read(tracker_in, robot));
  tracker_in.finish();
  // A file may hold the settings of several laws; `kind` chooses, the others are passed over.
  for (const char* other : {"lqr", "mpc", "decoupled"}) in.raw(other);
  in.finish();

  // Within one event: estimate, then plan, then track.
  estimator_task_ = calendar.addTask("estimator", scenario.rates.estimator, {}, "rates.estimator_period_us");
  planner_task_ = calendar.addTask("planner", scenario.rates.planner, {}, "rates.planner_period_us");
  tracker_task_ = calendar.addTask("tracker", scenario.rates.tracker, {}, "rates.tracker_period_us");
  requireWholeMultiple(plan_latency_ + calendar.baseStep(), calendar.baseStep(), "rates.plan_latency_us");
}

void RobotController::onSensors(SimTime now, const SensorFrame& sensors, DueTasks due,
                                ControlOutput& out) noexcept {
  if (due.has(estimator_task_)) {
    // Frames in between are not its business: so the log, which keeps one frame per period of the
    // estimator, holds all that it ever saw.
    estimator_->update(sensors, now < release_);
    const StateEstimate estimate = estimator_->estimate(now);
    if (now < release_) {
      contact_force_->reset();  // the stand holds the arm, too
    } else {
      contact_force_->update(now, estimate.x, sensors.joint_torque);
      law_->setContactForce(contact_force_->force());
    }
    out.has_estimate = true;
    toMessage(now, estimate.x, estimate.sigma, estimate.aligned, out.estimate);
    Eigen::Map<Vector3>{out.estimate.contact_force_W} = contact_force_->force();
  }
  // A plan that has become old enough acts before a new one is begun.
  if (plan_pending_ && now >= pending_since_ + plan_latency_) {
    law_->activatePlan();
    plan_pending_ = false;
    has_policy_ = true;
  }
  if (due.has(planner_task_) && !plan_pending_) plan(now, sensors, out);
  if (due.has(tracker_task_)) track(now, sensors, out);
}

void RobotController::plan(SimTime now, const SensorFrame& sensors, ControlOutput& out) {
  const std::int64_t started = wall_clock_ns_ ? wall_clock_ns_() : 0;
  const PlanReport report = law_->plan(now, estimator_->estimate(now).x, sensors.joint_angle);
  if (wall_clock_ns_ && plan_times_ns_.size() < plan_times_ns_.capacity()) {
    plan_times_ns_.push_back(wall_clock_ns_() - started);
  }
  ++plans_;
  if (!report.accepted) ++plans_refused_;
  out.has_plan = true;
  out.plan.sim_time_ns = toNs(now);
  out.plan.acts_from_ns = toNs(now + plan_latency_);
  out.plan.accepted = report.accepted;
  out.plan.iterations = report.iterations;
  out.plan.cost = report.cost;
  out.plan.step_length = report.step_length;
  out.plan.constraint_violation = report.constraint_violation;
  out.plan.contact_state = report.contact.state;
  Eigen::Map<Vector3>{out.plan.contact_asked_W} = report.contact.asked_W;
  Eigen::Map<Vector3>{out.plan.contact_counted_on_W} = report.contact.counted_on_W;
  if (plan_latency_ == SimDuration::zero() || !has_policy_) {
    // The first plan acts at once: it was made while the stand still held the robot.
    law_->activatePlan();
    has_policy_ = true;
  } else {
    plan_pending_ = true;
    pending_since_ = now;
  }
}

void RobotController::track(SimTime now, const SensorFrame& sensors, ControlOutput& out) {
  if (!has_policy_) return;
  law_->sample(now, policy_);
  const StateVector x = estimator_->estimate(now).x;
  switch (tracker_->step(policy_, x, sensors.joint_angle, sensors.joint_velocity, out.command)) {
    case TrackStatus::kOk: break;
    case TrackStatus::kTorqueSaturated: ++ticks_saturated_; break;
    case TrackStatus::kNotFinite: ++ticks_not_finite_; break;
  }
  if (now >= release_) {
    const ActuatorCommand& c = out.command;  // with the PD in the drives, their part is added here
    const JointVector whole = c.torque + c.stiffness.cwiseProduct(c.position - sensors.joint_angle) +
                              c.damping.cwiseProduct(c.velocity - sensors.joint_velocity);
    feedforward_share_.add(policy_.torque, whole - policy_.torque);
  }
  law_->commanded(now, tracker_period_, out.command.torque);
}

void RobotController::timePlans(std::function<std::int64_t()> wall_clock_ns, std::size_t capacity) {
  wall_clock_ns_ = std::move(wall_clock_ns);
  plan_times_ns_.reserve(capacity);  // the control step must not allocate
}

StateBlob RobotController::saveState() const {
  BlobWriter out;
  out.putBlob(estimator_->saveState());
  out.putBlob(law_->saveState());
  contact_force_->save(out);
  putPolicySample(out, policy_);
  out.put(plan_pending_);
  out.put(has_policy_);
  out.put(toNs(pending_since_));
  out.put(plans_);
  out.put(plans_refused_);
  out.put(ticks_saturated_);
  out.put(ticks_not_finite_);
  feedforward_share_.save(out);
  return out.seal("controller", 2);
}

void RobotController::restoreState(const StateBlob& blob) {
  BlobReader in(blob, "controller", 2);
  estimator_->restoreState(in.getBlob());
  law_->restoreState(in.getBlob());
  contact_force_->restore(in);
  law_->setContactForce(contact_force_->force());
  getPolicySample(in, policy_);
  plan_pending_ = in.get<bool>();
  has_policy_ = in.get<bool>();
  pending_since_ = simTimeFromNs(in.get<std::int64_t>());
  plans_ = in.get<std::int64_t>();
  plans_refused_ = in.get<std::int64_t>();
  ticks_saturated_ = in.get<std::int64_t>();
  ticks_not_finite_ = in.get<std::int64_t>();
  feedforward_share_.restore(in);
  in.finish();
}

std::map<std::string, double> RobotController::counters() const {
  const auto number = [](std::int64_t n) { return static_cast<double>(n); };
  std::map<std::string, double> out = rejectionMetrics(estimator_->rejections());
  out["plans"] = number(plans_);
  out["plans_refused"] = number(plans_refused_);
  out["ticks_saturated"] = number(ticks_saturated_);
  out["ticks_not_finite"] = number(ticks_not_finite_);
  return out;
}

}  // namespace ballbot
