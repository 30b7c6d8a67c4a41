#include "controller/mpc_settings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "controller/background_mpc_law.hpp"
#include "controller/law_kinds.hpp"
#include "controller/mpc_law.hpp"
#include "controller/resting_schedule.hpp"
#include "controller/shaped_lqr.hpp"
#include "controller/task_reference.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

MpcConfig readConfig(ConfigReader& controller, const RobotParameters& robot) {
  ConfigReader mpc = controller.child("mpc");
  MpcConfig config = MpcConfig::read(mpc, robot);
  if (controller.has("lqr")) {
    ConfigReader lqr = controller.child("lqr");
    config.lqr = LqrLawConfig::read(lqr, robot);
  }
  return config;
}

}  // namespace

MpcSettings::MpcSettings(ConfigReader& controller, const RobotParameters& robot)
    : LawSettings(robot),
      config_(readConfig(controller, robot)),
      fallback_after_(controller.child("mpc").at("fallback_after_ms")) {}

std::unique_ptr<ControlLaw> MpcSettings::makeLaw() const {
  if (config_.solver_thread) return std::make_unique<BackgroundMpcLaw>(robot(), config_);
  return std::make_unique<MpcLaw>(robot(), config_);
}

std::unique_ptr<ControlLaw> MpcSettings::makeLawAtRest(SimTime at) const {
  MpcConfig resting = config_;
  resting.schedule = std::make_shared<const TaskSchedule>(
      restingSchedule(robot(), *config_.schedule, toSeconds(at)));
  return std::make_unique<MpcLaw>(robot(), resting);
}

std::shared_ptr<const MotionReference> MpcSettings::reference() const {
  return std::make_shared<TaskReference>(config_.schedule);
}

std::optional<QuadraticCost> MpcSettings::costAt(SimTime at, const ArmVector& arm) const {
  Tasks tasks;
  config_.schedule->at(toSeconds(at), toSeconds(at), tasks);
  QuadraticCost cost;
  cost.Q = stateWeightOfTasks(robot(), config_.constraints, tasks, arm);
  cost.R << WheelVector::Constant(tasks.wheel_torque_weight),
      ArmVector::Constant(tasks.arm_torque_weight);
  cost.shaping = config_.shaping;
  return cost;
}

std::vector<AddedSignal> MpcSettings::addedToPlan() const {
  std::vector<AddedSignal> out;
  for (const auto& task : config_.schedule->added) {
    out.push_back({"cost_" + task->name(), "", "cost of the task '" + task->name() + "'"});
  }
  return out;
}

void MpcSettings::requireRates(SimDuration period, SimDuration latency) const {
  // A plan is begun when the one before has begun to act, at the next of the planner's times.
  const std::int64_t periods =
      std::max<std::int64_t>(1, (latency + period - SimDuration(1)) / period);
  const SimDuration oldest = periods * period + latency;
  if (oldest <= config_.fallback_after) return;
  const auto ms = [](SimDuration d) { return 1e3 * toSeconds(d); };
  throw InputError(fmt::format(
      "{} is {:g}, must be at least {:g}: so old is a plan when the next one takes over, with {:g} "
      "ms from plan to plan (rates.planner_period_us) and {:g} ms until one acts "
      "(rates.plan_latency_us). Until then the LQR would stand in",
      fallback_after_, ms(config_.fallback_after), ms(oldest), ms(periods * period), ms(latency)));
}

LawSection mpcSection() {
  return {may("mpc", "the MPC, needed by the kinds mpc and decoupled"),
          [](ConfigVisitor& v, const RobotParameters& robot) { MpcConfig(robot).describe(v); }};
}

LawKind mpcKind() {
  return {"mpc",
          {lqrSection(), mpcSection()},
          [](ConfigReader& in, const RobotParameters& robot) -> std::unique_ptr<LawSettings> {
            return std::make_unique<MpcSettings>(in, robot);
          }};
}

}  // namespace ballbot
