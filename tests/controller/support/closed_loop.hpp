#pragma once

#include <functional>
#include <vector>

#include "controller/control_law.hpp"
#include "controller/pd_tracker.hpp"
#include "tests/controller/support/lagged_plant.hpp"

namespace ballbot {

/// A control law, the tracker and the stand-in plant in lockstep: plans every `plan_steps`, acting
/// `latency_steps` later, the tracker at every step.
struct ClosedLoopOptions {
  int plan_steps = 35;     ///< 14 ms
  int latency_steps = 20;  ///< 8 ms
  double noise = 1;        ///< times (angles 2 mrad, base rates 0.01 rad/s, joint rates 0.02 rad/s)
  LagParameters lag;
  std::function<Vector3(double)> push;  ///< force on the base over time [N]; none if empty
  /// Force of the surroundings on the end-effector over time, measured as it is [N]; none if empty.
  std::function<Vector3(double, const ReducedDynamics::EndEffector&)> touch;
};

struct ClosedLoopSample {
  double time;  ///< [s]
  StateVector x;
  JointVector command, torque;
  double tilt;
  PlanReport plan;  ///< the newest
};

/// One sample per step of LaggedPlant::kStep. Ends early when the robot has fallen (tilt > 1 rad).
std::vector<ClosedLoopSample> runClosedLoop(ControlLaw& law, const TrackerConfig& tracker,
                                            const RobotParameters& robot, const StateVector& x0,
                                            double duration_s,
                                            const ClosedLoopOptions& options = {});

}  // namespace ballbot
