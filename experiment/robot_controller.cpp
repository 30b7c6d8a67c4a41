#include "experiment/robot_controller.hpp"

#include <algorithm>
#include <type_traits>

#include "controller/policy_sample_blob.hpp"
#include "experiment/rejection_metrics.hpp"
#include "experiment/run_metrics.hpp"
#include "model/pd_law.hpp"

namespace ballbot {
namespace {

constexpr const char* kBlobKind = "controller";
constexpr std::uint32_t kBlobVersion = 7;

}  // namespace

RobotController::RobotController(const RunConfig& config, EventCalendar& calendar)
    : release_(config.scenario.release),
      tracker_period_(config.scenario.rates.tracker),
      plan_latency_(config.scenario.rates.plan_latency),
      sensing_(config),
      law_(config.controller.makeLaw()),
      tracker_(std::make_unique<PdTracker>(config.controller.tracker)) {
  added_to_plan_.list = config.controller.law->addedToPlan();
  added_to_plan_.values.assign(added_to_plan_.list.size(), 0.0);
  const Rates& rates = config.scenario.rates;
  // Within one event: estimate, then plan, then track.
  estimator_task_ =
      calendar.addTask("estimator", rates.estimator, {}, "rates.estimator_period_us");
  planner_task_ = calendar.addTask("planner", rates.planner, {}, "rates.planner_period_us");
  tracker_task_ = calendar.addTask("tracker", rates.tracker, {}, "rates.tracker_period_us");
  if (plan_latency_ > SimDuration::zero()) {
    requireWholeMultiple(plan_latency_, calendar.baseStep(), "rates.plan_latency_us");
  }
}

void RobotController::onSensors(SimTime now, const SensorFrame& sensors, DueTasks due,
                                ControlOutput& out) noexcept {
  if (due.has(estimator_task_)) {
    // Frames in between are not its business: so the log, which keeps one frame per period of the
    // estimator, holds all that it ever saw.
    sensing_.update(sensors);
    law_->setContactForce(sensing_.contactForce());
    out.has_estimate = true;
    sensing_.write(now, out.estimate);
    if (const auto own = sensing_.estimator().selfAssessment()) {
      out.has_self_assessment = true;
      out.self_assessment = *own;
    }
  }
  // A plan that has become old enough acts before a new one is begun.
  if (plan_pending_ && now >= pending_since_ + plan_latency_) {
    law_->activatePlan();
    plan_pending_ = false;
    has_policy_ = true;
  }
  if ((due.has(planner_task_) || plan_now_) && !plan_pending_) plan(now, sensors, out);
  if (due.has(tracker_task_)) track(now, sensors, out);
}

void RobotController::plan(SimTime now, const SensorFrame& sensors, ControlOutput& out) {
  const std::int64_t started = wall_clock_ns_ ? wall_clock_ns_() : 0;
  const PlanReport report = law_->plan(now, sensing_.estimate(now).x, sensors.joint_angle);
  if (wall_clock_ns_) {
    out.plan_timing = {wall_clock_ns_() - started, report.times.approximation_ns,
                       report.times.riccati_ns, report.times.line_search_ns};
  }
  plan_now_ = false;
  ++plans_;
  if (!report.accepted) ++plans_refused_;
  if (report.fallback) ++plans_on_fallback_;
  if (report.command_cut) ++plans_cut_;
  out.has_plan = true;
  out.plan.time = now;
  out.plan.acts_from = now + plan_latency_;
  out.plan.accepted = report.accepted;
  out.plan.iterations = report.iterations;
  out.plan.cost = report.cost;
  out.plan.step_length = report.step_length;
  out.plan.constraint_violation = report.constraint_violation;
  out.plan.contact_state = report.contact.state;
  out.plan.contact_asked_W = report.contact.asked_W;
  out.plan.contact_counted_on_W = report.contact.counted_on_W;
  out.plan.status = static_cast<std::int8_t>(report.status);
  out.plan.fallback = report.fallback;
  out.plan.predicted_decrease = report.predicted_decrease;
  out.plan.regularisation = report.regularisation;
  std::copy_n(report.terms.added.begin(), added_to_plan_.values.size(),
              added_to_plan_.values.begin());
  static_assert(std::tuple_size<decltype(out.plan.cost_terms)>::value == kCostTermCount);
  std::copy(report.terms.value.begin(), report.terms.value.end(), out.plan.cost_terms.begin());
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
  const StateVector x = sensing_.estimate(now).x;
  switch (tracker_->step(policy_, x, sensors.joint_angle, sensors.joint_velocity, out.command)) {
    case TrackStatus::kOk: break;
    case TrackStatus::kTorqueSaturated: ++ticks_saturated_; break;
    case TrackStatus::kNotFinite: ++ticks_not_finite_; break;
  }
  if (now >= release_) {
    ++ticks_released_;
    if (policy_.from_stand_in) ++ticks_on_fallback_;
    // With the PD in the drives, their part is added here.
    const JointVector whole = pdTorque(out.command, sensors.joint_angle, sensors.joint_velocity);
    feedforward_share_.add(policy_.torque, whole - policy_.torque);
  }
  law_->commanded(now, tracker_period_, out.command.torque);
}

void RobotController::setWallClock(PhaseClock now_ns) {
  wall_clock_ns_ = now_ns;
  law_->setClock(now_ns);
}

StateBlob RobotController::saveState() const {
  BlobWriter out;
  sensing_.save(out);
  out.putBlob(law_->saveState());
  putPolicySample(out, policy_);
  out.put(plan_pending_);
  out.put(has_policy_);
  out.put(plan_now_);
  out.put(toNs(pending_since_));
  out.put(plans_);
  out.put(plans_refused_);
  out.put(plans_on_fallback_);
  out.put(plans_cut_);
  out.put(ticks_saturated_);
  out.put(ticks_not_finite_);
  out.put(ticks_released_);
  out.put(ticks_on_fallback_);
  feedforward_share_.save(out);
  return out.seal(kBlobKind, kBlobVersion);
}

void RobotController::restoreState(const StateBlob& blob) { restore(blob, true); }

void RobotController::takeOver(const StateBlob& blob) {
  restore(blob, false);
  plan_pending_ = has_policy_ = false;
  plan_now_ = true;
}

void RobotController::restore(const StateBlob& blob, bool with_law) {
  BlobReader in(blob, kBlobKind, kBlobVersion);
  sensing_.restore(in);
  const StateBlob law = in.getBlob();
  if (with_law) law_->restoreState(law);
  law_->setContactForce(sensing_.contactForce());
  getPolicySample(in, policy_);
  plan_pending_ = in.get<bool>();
  has_policy_ = in.get<bool>();
  plan_now_ = in.get<bool>();
  pending_since_ = simTimeFromNs(in.get<std::int64_t>());
  plans_ = in.get<std::int64_t>();
  plans_refused_ = in.get<std::int64_t>();
  plans_on_fallback_ = in.get<std::int64_t>();
  plans_cut_ = in.get<std::int64_t>();
  ticks_saturated_ = in.get<std::int64_t>();
  ticks_not_finite_ = in.get<std::int64_t>();
  ticks_released_ = in.get<std::int64_t>();
  ticks_on_fallback_ = in.get<std::int64_t>();
  feedforward_share_.restore(in);
  in.finish();
}

std::map<std::string, double> RobotController::metrics() const {
  const auto number = [](std::int64_t n) { return static_cast<double>(n); };
  std::map<std::string, double> out = rejectionMetrics(sensing_.estimator().rejections());
  out.merge(feedforward_share_.values());
  out["plans"] = number(plans_);
  out["plans_refused"] = number(plans_refused_);
  out["plans_on_fallback"] = number(plans_on_fallback_);
  out["plans_with_cut_commands"] = number(plans_cut_);
  out["ticks_saturated"] = number(ticks_saturated_);
  out["ticks_not_finite"] = number(ticks_not_finite_);
  if (ticks_released_ > 0) {
    out[kFallbackPercent] = 100 * number(ticks_on_fallback_) / number(ticks_released_);
  }
  return out;
}

std::vector<std::string> RobotController::metricNames() const {
  std::vector<std::string> names = FeedforwardShare::names();
  for (const auto& metric : metrics()) names.push_back(metric.first);
  names.push_back(kFallbackPercent);
  return names;
}

}  // namespace ballbot
