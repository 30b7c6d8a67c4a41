#include "tests/controller/support/closed_loop.hpp"

#include <cmath>

#include "core/random.hpp"

namespace ballbot {
namespace {

StateVector measured(const StateVector& x, double noise, std::uint64_t index) {
  static const RandomStream stream(7, "closed_loop");
  StateVector sigma;
  sigma << 0.002, 0.002, Vector3::Constant(0.002), Vector3::Constant(4e-4), 0.003, 0.003,
      Vector3::Constant(0.01), Vector3::Constant(0.02);
  StateVector out = x;
  for (int block = 0; block < kStateDim / 4; ++block) {
    const auto draw = stream.normals(index, block);
    for (int i = 0; i < 4; ++i) out[4 * block + i] += noise * sigma[4 * block + i] * draw[i];
  }
  return out;
}

}  // namespace

std::vector<ClosedLoopSample> runClosedLoop(ControlLaw& law, const TrackerConfig& tracker_config,
                                            const RobotParameters& robot, const StateVector& x0,
                                            double duration_s, const ClosedLoopOptions& options) {
  const PdTracker tracker(tracker_config);
  const ReducedDynamics dynamics(robot);
  LaggedPlant plant(robot, options.lag, x0);
  ActuatorCommand command;
  std::vector<ClosedLoopSample> out;
  const auto step_ns = static_cast<std::int64_t>(std::llround(LaggedPlant::kStep * 1e9));
  const int steps = static_cast<int>(std::lround(duration_s / LaggedPlant::kStep));
  int activate_at = -1;
  StateVector x = x0;
  PlanReport report;
  for (int k = 0; k < steps; ++k) {
    const SimTime now = simTimeFromNs(k * step_ns);
    const double t = k * LaggedPlant::kStep;
    if (options.touch) {
      plant.touch = [&options, t](const ReducedDynamics::EndEffector& tip) {
        return options.touch(t, tip);
      };
    }
    if (k % 6 == 0) x = measured(plant.x(), options.noise, k);  // the estimator's 400 Hz
    if (options.touch) {
      Circumstances touched;
      touched.contact_force_W = options.touch(t, dynamics.endEffector(plant.x()));
      law.setCircumstances(touched);
    }
    if (k % options.plan_steps == 0) {
      report = law.plan(now, x, plant.jointAngle());
      activate_at = k == 0 ? 0 : k + options.latency_steps;
    }
    if (k == activate_at) law.activatePlan();
    PolicySample policy;
    law.sample(now, policy);
    if (tracker.step(policy, x, plant.jointAngle(), plant.jointVelocity(), command) ==
        TrackStatus::kNotFinite) {
      break;
    }
    law.commanded(now, SimDuration(step_ns), command.torque);
    plant.step(command.torque, options.push ? options.push(t) : Vector3::Zero());
    out.push_back({t, plant.x(), command.torque, plant.torque(), plant.tilt(), report});
    if (!(plant.tilt() < 1)) break;
  }
  return out;
}

}  // namespace ballbot
