#include "controller/mpc_planner.hpp"

#include <fmt/format.h>

#include "controller/added_task_check.hpp"
#include "controller/continuous_engine.hpp"
#include "controller/discrete_engine.hpp"
#include "controller/reference_limits.hpp"
#include "controller/solver_settings.hpp"
#include "core/config_visitor.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

template <int NU>
std::unique_ptr<MpcEngine> makeEngineOf(const RobotParameters& robot, const MpcConfig& c) {
  SlqOptions options;
  options.threads = c.threads;
  options.clock = c.clock;
  TerminalCost terminal = c.terminal;
  terminal.lqr_weights = c.lqr.weights;
  if (c.engine == MpcConfig::Engine::kContinuous) {
    return std::make_unique<ContinuousEngine<NU>>(robot, c.constraints, c.shaping, terminal,
                                                  c.horizon.knots(), c.schedule, options,
                                                  c.continuous);
  }
  return std::make_unique<DiscreteEngine<NU>>(robot, c.constraints, c.shaping, terminal,
                                              c.horizon.knots(), c.schedule, options);
}

/// A plan whose torques cost nothing is no problem with a solution. Asked before all is read, for
/// what is merely missing would be named without this reason.
void requireTorqueTasks(ConfigReader& in) {
  if (!in.has("tasks")) return;  // the reader says so
  const ConfigReader tasks = in.child("tasks");
  for (const char* key : {"wheel_torque", "arm_torque"}) {
    if (tasks.has(key)) continue;
    throw InputError(fmt::format("{} is missing: a torque must cost something", tasks.at(key)));
  }
}

/// A contact task is in vain where the plan has no such inputs.
void requireInputsFor(ConfigReader& tasks, const char* task, const char* inputs, bool given) {
  if (tasks.has(task) && !given) {
    throw InputError(fmt::format("{} needs controller.mpc.{}: true", tasks.at(task), inputs));
  }
}

PlanStatus planStatus(SlqStatus status) {
  switch (status) {
    case SlqStatus::kImproved:
      return PlanStatus::kImproved;
    case SlqStatus::kConverged:
      return PlanStatus::kConverged;
    case SlqStatus::kNoDescent:
      return PlanStatus::kNoDescent;
    case SlqStatus::kNotFinite:
      return PlanStatus::kNotFinite;
    case SlqStatus::kNotConvex:
      return PlanStatus::kNotConvex;
  }
  return PlanStatus::kNotFinite;
}

}  // namespace

MpcConfig::MpcConfig(const RobotParameters& robot)
    : constraints(robot),
      schedule(std::make_shared<TaskSchedule>(robot)),
      lqr(LqrLawConfig::defaults(robot)) {}

void MpcConfig::describe(ConfigVisitor& v) {
  v.choice(may("engine",
               "how plans are solved: in fixed steps, or in continuous time as in the paper, "
               "which is slower and checks the other"),
           engine, {{"discrete", Engine::kDiscrete}, {"continuous", Engine::kContinuous}});
  v.section(may("horizon", "how far plans look ahead, and in which steps"),
            [&](ConfigVisitor& in) { ballbot::describe(in, horizon); });
  v.integer(may("iterations", "steps of the solver for each plan; more come closer to the optimum"),
            iterations, {1, 1000});
  v.integer(may("first_iterations", "steps of the solver for a plan that starts from the LQR"),
            first_iterations, {1, 1000});
  v.integer(may("threads", "of the solver; results are the same with one and two"), threads,
            {1, 2});
  v.boolean(may("solver_thread",
                "whether plans are solved beside the control loop: for real time, and "
                "not repeatable"),
            solver_thread);
  v.boolean(may("contact_forces", "whether a plan may push with the end-effector"), contact_forces);
  v.boolean(may("contact_moments", "whether it may twist as well; needs contact_forces"),
            contact_moments);
  v.section(may("contact_supervision",
                "what plans may count on at the end-effector, by the force "
                "that is measured"),
            [&](ConfigVisitor& in) { contact_supervision.describe(in); });
  v.section(may("command_limits", "what plans take at once of commands that are far away"),
            [&](ConfigVisitor& in) { command_limits.describe(in); });
  v.duration(
      may("fallback_after_ms",
          "how long plans may fail before the LQR takes over; at most the length of the horizon"),
      fallback_after, {1, 1e6});
  v.section(may("continuous", "settings of the continuous engine"), [&](ConfigVisitor& in) {
    in.number(may("relative_tolerance",
                  "error that its integrators allow in each step; smaller is slower"),
              continuous.tolerance, {1e-10, 1e-2});
  });
  v.section(
      may("wheel_shaping", "weight on those torques of the wheels that their drives cannot follow"),
      [&](ConfigVisitor& in) { ballbot::describe(in, shaping); });
  v.section(may("constraints", "limits that plans keep, each as a barrier in the cost"),
            [&](ConfigVisitor& in) { constraints.describe(in); });
  v.section(may("terminal", "what comes after the horizon, as a cost of its end"),
            [&](ConfigVisitor& in) { terminal.describe(in); });
  v.section(must("tasks",
                 "what the robot is asked for: the cost is half the sum of weight times "
                 "squared error"),
            [&](ConfigVisitor& in) {
              auto described = std::make_shared<TaskSchedule>(*schedule);
              described->describe(in);
              schedule = std::move(described);
            });
}

MpcConfig MpcConfig::read(ConfigReader& in, const RobotParameters& robot) {
  MpcConfig c(robot);
  requireTorqueTasks(in);
  readDescribed(in, c);
  c.constraints.takeShares(robot);
  if (in.has("horizon")) requireWholeSteps(in.child("horizon"), c.horizon);
  if (c.contact_moments && !c.contact_forces) {
    throw InputError(
        fmt::format("{} is true, needs contact_forces: true beside it", in.at("contact_moments")));
  }
  if (c.engine == MpcConfig::Engine::kContinuous && !c.schedule->added.empty()) {
    throw InputError(
        fmt::format("{} is continuous, which knows no tasks on frames and none that were added: "
                    "leave them out, "
                    "or set engine: discrete",
                    in.at("engine")));
  }
  if (toSeconds(c.fallback_after) > c.horizon.length) {
    throw InputError(fmt::format(
        "{} is {:g}, which is beyond the end of a plan: at most {:g}, the "
        "length of the horizon",
        in.at("fallback_after_ms"), 1e3 * toSeconds(c.fallback_after), 1e3 * c.horizon.length));
  }
  ConfigReader tasks = in.child("tasks");
  requireInputsFor(tasks, "contact_force", "contact_forces", c.contact_forces);
  requireInputsFor(tasks, "contact_moment", "contact_moments", c.contact_moments);
  requireWithinLimits(*c.schedule, c.constraints, robot, tasks);
  in.finish();
  return c;
}

std::unique_ptr<MpcEngine> makeEngine(const RobotParameters& robot, const MpcConfig& config) {
  if (config.contact_moments) return makeEngineOf<kJointCount + 6>(robot, config);
  if (config.contact_forces) return makeEngineOf<kJointCount + 3>(robot, config);
  return makeEngineOf<kJointCount>(robot, config);
}

MpcPlanner::MpcPlanner(const RobotParameters& robot, const MpcConfig& config)
    : config_(config),
      dynamics_(robot),
      supervisor_(config.contact_supervision),
      governor_(robot, config.command_limits),
      known_payload_(robot.payload_mass),
      engine_(makeEngine(robot, config)),
      seed_(engine_->emptyPolicy()) {
  governor_.governAdded(config.schedule->added);
  const LqrSolution lqr = designLqr(dynamics_, config.lqr.set_point.arm, config.lqr.weights);
  if (config.engine == MpcConfig::Engine::kDiscrete) {
    seed_gains_ = designHeldLqr(dynamics_, lqr, config.lqr.weights, config.horizon.knots());
  } else {  // its feedback acts at every instant
    seed_gains_.assign(seed_.controls().size(), lqr.K);
  }
}

void MpcPlanner::seedFrom(const PolicySample& stand_in, SimTime now, double yaw) noexcept {
  for (auto& knot : seed_.knots()) knot.x << stand_in.x, Vector3::Zero();
  for (std::size_t k = 0; k < seed_gains_.size(); ++k) {
    auto& control = seed_.controls()[k];
    control.u << stand_in.torque, ContactInput::Zero();
    control.K.setZero();
    control.K.topLeftCorner<kJointCount, kStateDim>() = gainAtYaw(seed_gains_[k], yaw);
  }
  seed_.setValid(now);
}

ContactReport MpcPlanner::superviseContact(SimTime now, const Vector3& p_WE) noexcept {
  ContactReport report;
  if (!config_.contact_forces) return report;
  const TaskSchedule& schedule = *config_.schedule;
  ContactSituation situation;
  situation.turn = schedule.turnAboutHinge(p_WE);
  const double t = toSeconds(now - kSimStart), turn = situation.turn;
  Tasks tasks;
  schedule.at(t, t, tasks, situation);
  if (tasks.inContact()) report.asked_W = tasks.R_WC * tasks.contact_force_C;
  schedule.at(t, t, tasks, situation, governor_.commands());
  const double asked = tasks.inContact() ? tasks.contact_force_C.z() : 0;
  supervisor_.update(now, asked, tasks.R_WC.col(2).dot(circumstances_.contact_force_W));
  situation = supervisor_.situation();
  situation.turn = turn;
  engine_->setContact(situation);
  schedule.at(t, t, tasks, situation, governor_.commands());
  if (tasks.inContact()) report.counted_on_W = tasks.R_WC * tasks.contact_force_C;
  report.state = static_cast<std::int8_t>(supervisor_.state());
  return report;
}

PlanConditions MpcPlanner::conditionsAt(const StateVector& x) noexcept {
  PlanConditions out;
  out.floor_held = circumstances_.floor_held;
  out.lost_wheels = circumstances_.lost_wheels;
  const LastingForces& lasting = circumstances_.lasting;
  out.payload = known_payload_ + lasting.hand_mass;
  if (*out.payload != dynamics_.robot().payload_mass) dynamics_.setPayload(*out.payload);
  if (!lasting.rest.isZero(0)) findLastingLoad(dynamics_, x, lasting.rest, out.load);
  // Where contact is planned, what is felt is the contact.
  if (!config_.contact_forces) {
    out.push =
        Push::on(dynamics_, x.head<kPositionDim>(), circumstances_.push, circumstances_.push_lasts);
  }
  return out;
}

GovernedCommands MpcPlanner::commandsAt(const StateVector& x,
                                        const LastingLoad& load) const noexcept {
  GovernedCommands out = governor_.commands();
  const PositionVector q = x.head<kPositionDim>();
  out.arm_rest_torque =
      dynamics_.nonlinearEffects(q, VelocityVector::Zero()).tail<kArmJointCount>() +
      load.shift.tail<kArmJointCount>();
  out.arm_position_wish = config_.constraints.armPositionWish(x.segment<kArmJointCount>(kArm1));
  out.arm_torque_wish = config_.constraints.armTorqueWish(out.arm_rest_torque);
  return out;
}

PlanReport MpcPlanner::plan(SimTime now, const StateVector& x, const Vector3& xf,
                            const JointVector& joint_angle, const PolicySample& stand_in,
                            const MpcPolicy& previous, MpcPolicy& out) noexcept {
  PlanReport report;
  report.accepted = false;
  if (!x.allFinite() || !xf.allFinite() || !joint_angle.allFinite()) {
    report.status = PlanStatus::kStateNotFinite;
    return report;
  }
  const ReducedDynamics::EndEffector tip = dynamics_.endEffector(x);
  report.contact = superviseContact(now, tip.p_WE);
  governor_.update(now, *config_.schedule, x, tip);
  report.command_cut = governor_.cutting();
  const PlanConditions conditions = conditionsAt(x);
  engine_->setConditions(conditions);
  engine_->setCommands(commandsAt(x, conditions.load));
  const bool fresh = previous.valid() && now - previous.stamp() <= config_.fallback_after;
  if (!fresh) seedFrom(stand_in, now, x[kYaw]);
  MpcState x0;
  x0 << x, xf;
  MpcSolveReport slq = engine_->solve(now, x0, fresh ? previous : seed_,
                                      fresh ? config_.iterations : config_.first_iterations, out);
  if (fresh && !slq.ok()) {
    // After a jump of the state or of what acts the last plan may lead nowhere: begin anew at once.
    seedFrom(stand_in, now, x[kYaw]);
    engine_->setShift(SlqOptions{}.base_shift);
    report.begun_anew = true;
    slq = engine_->solve(now, x0, seed_, config_.first_iterations, out);
  }
  if (slq.ok()) out.integrateJoints(dynamics_, joint_angle);

  report.accepted = slq.ok();
  report.iterations = slq.iterations;
  report.cost = slq.cost;
  report.step_length = slq.step_length;
  report.constraint_violation = slq.terms.violation;
  report.status = planStatus(slq.status);
  report.predicted_decrease = slq.predicted_decrease;
  report.regularisation = slq.shift;
  report.terms = slq.terms;
  if (slq.status == SlqStatus::kNotFinite) {
    markNotFinite(*config_.schedule, toSeconds(now), x, report.terms);
  }
  report.times = slq.times;
  return report;
}

}  // namespace ballbot
