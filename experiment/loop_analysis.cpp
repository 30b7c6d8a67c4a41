#include "experiment/loop_analysis.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "core/error.hpp"
#include "model/actuator_response.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {
namespace {

double delayOf(const Scenario& scenario, const PlantConfig& plant, double policy_feedback) {
  if (policy_feedback == 0) {
    return toSeconds(scenario.rates.plan_latency) + 0.5 * toSeconds(scenario.rates.planner);
  }
  const double transport = plant.fidelity.transport_delay
                               ? plant.transport_delay_ticks * toSeconds(plant.drive_period)
                               : 0;
  return transport + 0.5 * toSeconds(scenario.rates.tracker);
}

}  // namespace

LoopAnalysis analyseLoop(const RunConfig& config, SimTime at,
                         const std::optional<SimDuration>& delay) {
  const PlantConfig& plant = config.plant.plant;
  const RobotParameters& robot = config.believedRobot();
  const auto cost = config.controller.law->costAt(at, robot.nominal_arm);
  if (!cost) {
    throw InputError(
        "the scenario's control law minimises no quadratic cost about an equilibrium, "
        "so its loop cannot be analysed; those of the LQR and the MPC can");
  }

  const ReducedDynamics dynamics(robot);
  LoopAnalysis out;
  out.shaping = cost->shaping;
  out.torque_weight = cost->R;
  out.drives = {plant.actuators, toSeconds(plant.drive_period)};
  out.delay = delay ? toSeconds(*delay)
                    : delayOf(config.scenario, plant, config.controller.tracker.policy_feedback);
  out.law = designShapedLqr(dynamics, robot.nominal_arm, cost->Q, cost->R, cost->shaping);
  out.inertia = freeInertia(dynamics, out.law.equilibrium.x.head<kPositionDim>());
  const SampledLoop sampled(config, at);
  out.margins = marginsOf(sampled);
  out.period = sampled.schedule().period;

  const TorqueLoop ideal(out.law, dynamics, std::nullopt, out.delay);
  const TorqueLoop driven(out.law, dynamics, out.drives, out.delay);
  out.with_ideal_drives = shapeOf(ideal);
  out.with_drives = shapeOf(driven);
  const ActuatorResponse wheel(plant.actuators.wheel, out.drives.drive_period);
  const ActuatorResponse arm(plant.actuators.arm, out.drives.drive_period);
  const auto gain = [](const TorqueLoop::Wheels& L) {
    return L.eigenvalues().cwiseAbs().maxCoeff();
  };
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
