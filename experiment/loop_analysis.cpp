#include "experiment/loop_analysis.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "controller/pd_tracker.hpp"
#include "core/config_reader.hpp"
#include "experiment/believed_robot.hpp"
#include "experiment/motion_metrics.hpp"
#include "model/actuator_response.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {
namespace {

/// Quadratic cost of the law that the scenario names.
struct Weights {
  StateJacobian Q;
  JointVector R;
  FrequencyShaping shaping;
};

Weights weightsOf(const Scenario& scenario, const RobotParameters& robot, SimTime at) {
  Weights w;
  ConfigReader controller(scenario.section("controller"), "controller");
  if (controller.text("kind") == "lqr") {
    ConfigReader in = controller.child("lqr");
    const LqrWeights lqr = LqrLawConfig::read(in, robot).weights;
    w.Q = lqr.stateWeight();
    w.R = lqr.torqueWeight();
    w.shaping.pole = w.shaping.zero;
    return w;
  }
  const MpcConfig mpc = *readMpc(scenario);
  Tasks tasks;
  mpc.schedule->at(toSeconds(at), toSeconds(at), tasks);
  w.Q = stateWeightOfTasks(robot, mpc.constraints, tasks, robot.nominal_arm);
  w.R << Vector3::Constant(tasks.wheel_torque_weight), Vector3::Constant(tasks.arm_torque_weight);
  w.shaping = mpc.shaping;
  return w;
}

double delayOf(const Scenario& scenario, const PlantConfig& plant, double policy_feedback) {
  if (policy_feedback == 0) {
    return toSeconds(scenario.rates.plan_latency) + 0.5 * toSeconds(scenario.rates.planner);
  }
  const double transport =
      plant.fidelity.transport_delay ? plant.transport_delay_ticks * toSeconds(plant.drive_period) : 0;
  return transport + 0.5 * toSeconds(scenario.rates.tracker);
}

}  // namespace

LoopAnalysis analyseLoop(const Scenario& scenario, SimTime at, const std::optional<SimDuration>& delay) {
  const PlantConfig plant = readPlantConfig(scenario.tree);
  const RobotParameters robot = believedRobot(scenario);
  ConfigReader controller(scenario.section("controller"), "controller");
  ConfigReader tracker_in = controller.child("tracker");
  const TrackerConfig tracker = TrackerConfig::read(tracker_in, robot);
  const Weights weights = weightsOf(scenario, robot, at);

  const ReducedDynamics dynamics(robot);
  LoopAnalysis out;
  out.shaping = weights.shaping;
  out.torque_weight = weights.R;
  out.drives = {plant.actuators, toSeconds(plant.drive_period)};
  out.delay = delay ? toSeconds(*delay) : delayOf(scenario, plant, tracker.policy_feedback);
  out.law = designShapedLqr(dynamics, robot.nominal_arm, weights.Q, weights.R, weights.shaping);
  out.inertia = freeInertia(dynamics, out.law.equilibrium.x.head<kPositionDim>());
  out.with_ideal_drives = marginsOf(out.law, dynamics, std::nullopt, out.delay);
  out.with_drives = marginsOf(out.law, dynamics, out.drives, out.delay);

  const TorqueLoop ideal(out.law, dynamics, std::nullopt, out.delay);
  const TorqueLoop driven(out.law, dynamics, out.drives, out.delay);
  const ActuatorResponse wheel(plant.actuators.wheel, out.drives.drive_period);
  const ActuatorResponse arm(plant.actuators.arm, out.drives.drive_period);
  const auto gain = [](const TorqueLoop::Wheels& L) { return L.eigenvalues().cwiseAbs().maxCoeff(); };
  const auto distance = [](const TorqueLoop::Wheels& L) {
    return (TorqueLoop::Wheels::Identity() + L).jacobiSvd().singularValues()[kWheelCount - 1];
  };
  for (const double omega : loopFrequencies()) {
    LoopAnalysis::Sample s{};
    s.omega = omega;
    s.shaping = out.shaping.filter(omega);
    s.weight = out.torque_weight[0] * out.shaping.weightRatio(omega);
    s.wheel_blocked = wheel.blocked(omega);
    s.wheel_loaded = wheel.loaded(omega, out.inertia[0]);
    s.arm_blocked = arm.blocked(omega);
    const TorqueLoop::Wheels L_ideal = ideal.wheels(omega), L = driven.wheels(omega);
    s.loop_gain_ideal = gain(L_ideal);
    s.loop_gain = gain(L);
    s.distance_ideal = distance(L_ideal);
    s.distance = distance(L);
    out.samples.push_back(s);
  }
  return out;
}

}  // namespace ballbot
