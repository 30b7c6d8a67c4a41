#include "experiment/robot_controller.hpp"

#include <algorithm>
#include <type_traits>

#include "core/state_visitors.hpp"
#include "experiment/rejection_metrics.hpp"
#include "experiment/run_metrics.hpp"
#include "model/pd_law.hpp"

namespace ballbot {
namespace {

constexpr const char* kBlobKind = "controller";
constexpr std::uint32_t kBlobVersion = 11;

WheelDrives wheelDrives(const RunConfig& config) {
  const ActuatorParameters& wheel = config.plant.plant.actuators.wheel;
  return {wheel.torque_bandwidth, wheel.speed_limit};
}

/// Whatever a lost wheel is asked for moves nothing, and would only make it race.
void withoutLost(const WheelFlags& lost, ActuatorCommand& command) noexcept {
  for (int i = 0; i < kWheelCount; ++i) {
    if (!lost[static_cast<std::size_t>(i)]) continue;
    command.torque[i] = command.stiffness[i] = command.damping[i] = 0;
  }
}

}  // namespace

RobotController::RobotController(const RunConfig& config, EventCalendar& calendar)
    : release_(config.scenario.release),
      tracker_period_(config.scenario.rates.tracker),
      plan_latency_(config.scenario.rates.plan_latency),
      sensing_(config),
      law_(config.controller.makeLaw()),
      tracker_(std::make_unique<PdTracker>(config.controller.tracker)),
      spin_torque_(config.believedRobot()),
      command_share_(config.controller.floor.command_share),
      beside_estimate_(besideEstimate(sensing_.estimator().knowsSpin(),
                                      config.controller.offset_free.enabled,
                                      config.controller.push.counted_on)),
      state_(FloorHold(config.believedRobot(), config.controller.floor),
             LostWheels(config.controller.wheel_loss), PushEstimate(config.controller.push),
             DeadDrives(config.controller.wheel_loss.drives, wheelDrives(config))) {
  added_[AddedTo::kPlan].list = config.controller.law->addedToPlan();
  for (const BesideSignal& beside : beside_estimate_) {
    added_[AddedTo::kEstimate].list.push_back(beside.signal);
  }
  for (AddedSignals& added : added_.of) added.values.assign(added.list.size(), 0.0);
  const Rates& rates = config.scenario.rates;
  // Within one event: estimate, then plan, then track.
  estimator_task_ = calendar.addTask("estimator", rates.estimator, {}, "rates.estimator_period_us");
  planner_task_ = calendar.addTask("planner", rates.planner, {}, "rates.planner_period_us");
  tracker_task_ = calendar.addTask("tracker", rates.tracker, {}, "rates.tracker_period_us");
  if (plan_latency_ > SimDuration::zero()) {
    requireWholeMultiple(plan_latency_, calendar.baseStep(), "rates.plan_latency_us");
  }
}

void RobotController::onSensors(SimTime now, const SensorFrame& sensors, DueTasks due,
                                ControlOutput& out) noexcept {
  if (due.has(estimator_task_)) estimate(now, sensors, out);
  // A plan that has become old enough acts before a new one is begun.
  if (state_.plan_pending && now >= state_.pending_since + plan_latency_) {
    law_->activatePlan();
    state_.plan_pending = false;
    state_.has_policy = true;
  }
  if ((due.has(planner_task_) || state_.plan_now) && !state_.plan_pending) plan(now, sensors, out);
  if (due.has(tracker_task_)) track(now, sensors, out);
}

void RobotController::estimate(SimTime now, const SensorFrame& sensors, ControlOutput& out) {
  // Frames in between are not its business: so the log, which keeps one frame per period of the
  // estimator, holds all that it ever saw.
  sensing_.update(sensors);
  out.has_estimate = true;
  const StateEstimate e = sensing_.write(now, out.estimate);
  if (const auto own = sensing_.estimator().selfAssessment()) {
    out.has_self_assessment = true;
    out.self_assessment = *own;
  }
  if (now >= release_ && sensing_.estimator().knowsSpin()) {
    state_.floor.update(now, e.x, e.spin_rate, sensors.joint_torque, sensors.joint_velocity);
  }
  if (now >= release_) {
    followWheels(now, sensors);
    followPush(now);
  }
  tellLaw();
  const BesideEstimate known{e, state_.floor.held(), sensing_.lasting(), state_.push};
  auto value = added_[AddedTo::kEstimate].values.begin();
  for (const BesideSignal& beside : beside_estimate_) *value++ = beside.value(known, beside.index);
}

void RobotController::followWheels(SimTime now, const SensorFrame& sensors) noexcept {
  const WheelFlags refused =
      state_.refused_wheels.since(sensing_.estimator().rejections(), sensors.joint_velocity);
  // A plan that counts on a wheel which is gone, or leaves out one which is back, is to be
  // replaced.
  if (state_.wheels.update(now, refused, state_.drives.dead())) state_.plan_now = true;
  state_.slipping = refused;
}

void RobotController::followPush(SimTime now) noexcept {
  // A jump that the first sample of a push is refused for says nothing against it.
  const RejectionCounts counts = sensing_.estimator().rejections();
  const std::int64_t rejected = counts.total() - counts[Rejection::kAccelSpike] -
                                counts[Rejection::kGyroSpike] -
                                counts[Rejection::kAccelInconsistent];
  const bool doubtful = rejected != state_.rejected || state_.wheels.any();
  state_.rejected = rejected;
  state_.push.update(now, sensing_.unexplainedForce(), doubtful);
}

void RobotController::tellLaw() noexcept {
  law_->setCircumstances({sensing_.contactForce(), state_.floor.held(), state_.wheels.lost(),
                          state_.push.force(), state_.push.settings().lasts,
                          sensing_.lasting().forces()});
}

void RobotController::plan(SimTime now, const SensorFrame& sensors, ControlOutput& out) {
  const std::int64_t started = wall_clock_ns_ ? wall_clock_ns_() : 0;
  const PlanReport report = law_->plan(now, sensing_.estimate(now).x, sensors.joint_angle);
  if (wall_clock_ns_) {
    out.plan_timing = {wall_clock_ns_() - started, report.times.approximation_ns,
                       report.times.riccati_ns, report.times.line_search_ns};
  }
  state_.plan_now = false;
  ++state_.plans;
  if (!report.accepted) ++state_.plans_refused;
  if (report.fallback) ++state_.plans_on_fallback;
  if (report.command_cut) ++state_.plans_cut;
  if (report.begun_anew) ++state_.plans_begun_anew;
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
  std::vector<double>& added = added_[AddedTo::kPlan].values;
  std::copy_n(report.terms.added.begin(), added.size(), added.begin());
  static_assert(std::tuple_size<decltype(out.plan.cost_terms)>::value == kCostTermCount);
  std::copy(report.terms.value.begin(), report.terms.value.end(), out.plan.cost_terms.begin());
  if (plan_latency_ == SimDuration::zero() || !state_.has_policy) {
    // The first plan acts at once: it was made while the stand still held the robot.
    law_->activatePlan();
    state_.has_policy = true;
  } else {
    state_.plan_pending = true;
    state_.pending_since = now;
  }
}

void RobotController::track(SimTime now, const SensorFrame& sensors, ControlOutput& out) {
  if (!state_.has_policy) return;
  PolicySample& policy = state_.policy;
  law_->sample(now, policy);
  const StateVector x = sensing_.estimate(now).x;
  switch (tracker_->step(policy, x, sensors.joint_angle, sensors.joint_velocity, out.command)) {
    case TrackStatus::kOk:
      break;
    case TrackStatus::kTorqueSaturated:
      ++state_.ticks_saturated;
      break;
    case TrackStatus::kNotFinite:
      ++state_.ticks_not_finite;
      break;
  }
  if (state_.wheels.any()) {
    withoutLost(state_.wheels.lost(), out.command);
  } else if (const double held = state_.floor.held(); held < kUnlimited) {
    spin_torque_.cut(command_share_ * held, x, out.command.torque);
  }
  if (now >= release_) {
    ++state_.ticks_released;
    if (policy.from_stand_in) ++state_.ticks_on_fallback;
    // With the PD in the drives, their part is added here.
    const JointVector whole = pdTorque(out.command, sensors.joint_angle, sensors.joint_velocity);
    state_.feedforward_share.add(policy.torque, whole - policy.torque);
    state_.drives.update(
        now, whole.head<kWheelCount>(),
        {sensors.joint_torque.head<kWheelCount>(), sensors.joint_velocity.head<kWheelCount>()},
        state_.slipping);
  }
  law_->commanded(now, tracker_period_, out.command.torque);
}

void RobotController::setWallClock(PhaseClock now_ns) {
  wall_clock_ns_ = now_ns;
  law_->setClock(now_ns);
}

struct RobotController::Whole {
  RobotSensing::State sensing;
  StateBlob law;
  State state;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.sensing);
    visit(self.law);
    visit(self.state);
  }
};

StateBlob RobotController::saveState() const {
  return saveStateOf(Whole{sensing_.state(), law_->saveState(), state_}, kBlobKind, kBlobVersion);
}

void RobotController::restoreState(const StateBlob& blob) { restore(blob, true); }

void RobotController::takeOver(const StateBlob& blob) {
  restore(blob, false);
  state_.plan_pending = state_.has_policy = false;
  state_.plan_now = true;
}

void RobotController::restore(const StateBlob& blob, bool with_law) {
  Whole whole{sensing_.state(), {}, state_};
  restoreStateOf(whole, blob, kBlobKind, kBlobVersion);
  sensing_.restore(whole.sensing);
  if (with_law) law_->restoreState(whole.law);
  state_ = whole.state;
  tellLaw();
}

std::map<std::string, double> RobotController::metrics() const {
  const auto number = [](std::int64_t n) { return static_cast<double>(n); };
  std::map<std::string, double> out = rejectionMetrics(sensing_.estimator().rejections());
  out.merge(state_.feedforward_share.values());
  out["plans"] = number(state_.plans);
  out["plans_refused"] = number(state_.plans_refused);
  out["plans_on_fallback"] = number(state_.plans_on_fallback);
  out["plans_with_cut_commands"] = number(state_.plans_cut);
  out["plans_begun_anew"] = number(state_.plans_begun_anew);
  out["wheels_lost"] = number(state_.wheels.losses());
  out["drives_dead"] = number(state_.drives.deaths());
  out["ticks_saturated"] = number(state_.ticks_saturated);
  out["ticks_not_finite"] = number(state_.ticks_not_finite);
  if (state_.ticks_released > 0) {
    out[kFallbackPercent] = 100 * number(state_.ticks_on_fallback) / number(state_.ticks_released);
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
