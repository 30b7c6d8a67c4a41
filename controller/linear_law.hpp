#pragma once

#include <vector>

#include "controller/control_law.hpp"
#include "controller/mpc_dimensions.hpp"
#include "controller/pd_tracker.hpp"

namespace ballbot {

/// What a plan is made from, in this order: state estimate x (16), filter state x_f (3), measured
/// joint angles (6).
enum PlanStart : int { kStartState = 0, kStartFilter = kStateDim, kStartJoints = kMpcStateDim };
constexpr int kPlanStartDim = kMpcStateDim + kJointCount;
using PlanStartVector = Eigen::Matrix<double, kPlanStartDim, 1>;

/// What the tracker looks at beside the plan: x (16), x_f (3), joint angles (6), joint rates (6).
enum TrackerInput : int {
  kNowState = 0,
  kNowFilter = kStateDim,
  kNowJoints = kMpcStateDim,
  kNowRates = kMpcStateDim + kJointCount
};
constexpr int kTrackerInputDim = kMpcStateDim + 2 * kJointCount;
using TrackerInputVector = Eigen::Matrix<double, kTrackerInputDim, 1>;

/// What the tracker sends: torque (6), and what the set-points of a PD in the drives add to it,
/// stiffness * position + damping * velocity (6) [N m].
enum TrackerOutput : int { kTorqueOut = 0, kSetPointOut = kJointCount };
constexpr int kTrackerOutputDim = 2 * kJointCount;

/// A law with its tracker to first order, at one age of a plan:
/// command = by_start (plan's start) + by_now (tracker's input), all as deviations from rest.
struct LinearCommand {
  Eigen::Matrix<double, kTrackerOutputDim, kPlanStartDim> by_start;
  Eigen::Matrix<double, kTrackerOutputDim, kTrackerInputDim> by_now;
};

/// Where a law is differentiated.
struct LawRest {
  StateVector x;
  JointVector torque;       ///< that holds the robot there; its wheels' part is the filter's state
  JointVector joint_angle;  ///< measured there
};

/// Differentiates a law as it runs, plan() and sample() themselves, about the plan that it arrives
/// at when it plans from `rest` again and again. A plan depends on the one before it only through
/// what a single iteration leaves undone, which is of second order in the deviation and left out.
/// @param at    time of all plans
/// @param ages  of a plan at which it is sampled
/// @throw NumericalError if the law refuses to plan from there or its command is not finite.
std::vector<LinearCommand> linearizeLaw(ControlLaw& law, const TrackerConfig& tracker,
                                        const LawRest& rest, SimTime at,
                                        const std::vector<SimDuration>& ages);

}  // namespace ballbot
