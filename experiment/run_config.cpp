#include "experiment/run_config.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "experiment/added_names.hpp"
#include "model/robot_reader.hpp"
#include "plant/simbody_library.hpp"

namespace ballbot {
namespace {

/// An FMU that takes steps of one size needs a run that has no others: a last one that is shorter
/// would end it without a result.
void requireEvenSteps(const Scenario& scenario, const FmuUse& fmu) {
  const Rates& r = scenario.rates;
  const SimDuration step = std::min({r.tracker, r.estimator, r.planner});
  const std::string why = fmt::format(
      "FMU '{}' takes steps of one size only (canHandleVariableCommunicationStepSize is false)",
      fmu.name);
  for (const SimDuration period : {r.tracker, r.estimator, r.planner}) {
    if (period % step == SimDuration::zero()) continue;
    throw InputError(
        fmt::format("rates: {}, but {} is no whole multiple of {}. Choose tracker, "
                    "estimator and planner periods that are multiples of the shortest",
                    why, toText(period), toText(step)));
  }
  if (scenario.duration % step == SimDuration::zero()) return;
  const SimDuration below = scenario.duration - scenario.duration % step;
  throw InputError(fmt::format("duration_s: {}, but {} is no whole multiple of {}. Nearest: {}, {}",
                               why, toText(scenario.duration), toText(step), toText(below),
                               toText(below + step)));
}

/// The estimator sees one sensor frame per period. Of an IMU that is faster it would see only the
/// last sample of each, and take those in between for lost.
void requireEveryImuSample(const Scenario& scenario, SimDuration imu_period) {
  const SimDuration estimator = scenario.rates.estimator;
  if (imu_period >= estimator) return;
  ConfigReader robot(scenario.section("robot"), "robot");
  throw InputError(fmt::format(
      "{} is {}, but the estimator looks once in {}, and would never see {:.0f} % of the samples. "
      "Set rates.estimator_period_us: {:g}, or the IMU to a period of {} or longer",
      robot.child("sensors").child("imu").at("period_ms"), toText(imu_period), toText(estimator),
      100 * (1 - toSeconds(imu_period) / toSeconds(estimator)), 1e6 * toSeconds(imu_period),
      toText(estimator)));
}

RobotParameters readNominalRobot(const Scenario& scenario) {
  ConfigReader in(scenario.section("robot"), "robot");
  return readRobot(in);
}

PlantSetup readPlantOf(const Scenario& scenario, const RobotParameters& robot) {
  requireSimbodyKind(loadedSimbodyKind());
  PlantSetup out{readPlantConfig(scenario.tree, robot), nullptr};
  if (scenario.tree.find("fmus")) {
    out.coupling = std::make_shared<CouplingPlan>(planCoupling(scenario.tree));
    for (const FmuUse& fmu : out.coupling->fmus) {
      if (!fmu.variable_steps) requireEvenSteps(scenario, fmu);
    }
  }
  return out;
}

/// Sensors and estimates are kept as often as the estimator runs, if nothing else is said.
Recording readRecording(const Scenario& scenario) {
  Recording out;
  out.log.sensors = out.log.estimate = scenario.rates.estimator;
  if (const ConfigNode* node = scenario.tree.find("recording")) {
    ConfigReader in(*node, "recording");
    readDescribed(in, out);
    in.finish();
  }
  return out;
}

}  // namespace

PlantSetup readPlantSetup(const Scenario& scenario) {
  return readPlantOf(scenario, readNominalRobot(scenario));
}

RunConfig readRunConfig(Scenario scenario) {
  RunConfig c;
  c.scenario = std::move(scenario);
  const Scenario& s = c.scenario;
  c.robot = readNominalRobot(s);
  ConfigReader controller(s.section("controller"), "controller");
  ConfigReader estimator(s.section("estimator"), "estimator");
  c.estimator = readEstimator(estimator);
  c.controller = ControllerSettings::read(controller, c.robot);
  c.recording = readRecording(s);
  c.controller.law->requireRates(s.rates.planner, s.rates.plan_latency);
  c.plant = readPlantOf(s, c.robot);
  requireNewNames(c.plant.plant.added_sensors.signals().list, "sensors");
  requireNewNames(c.controller.law->addedToPlan(), "plan");
  if (const std::size_t added = c.controller.law->addedToPlan().size(); added > kMaxAddedTasks) {
    throw InputError(
        fmt::format("the control law adds {} values to the record of a plan, at most {} "
                    "fit (PlanReport::terms.added)",
                    added, kMaxAddedTasks));
  }
  requireEveryImuSample(s, c.plant.plant.sensors.imu.period);
  if (!c.estimator->usesExternalPose()) c.home.yaw = c.plant.plant.initial.pose.yaw;
  return c;
}

}  // namespace ballbot
