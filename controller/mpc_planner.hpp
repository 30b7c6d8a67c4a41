#pragma once

#include <memory>

#include "controller/circumstances.hpp"
#include "controller/command_governor.hpp"
#include "controller/contact_supervisor.hpp"
#include "controller/continuous_engine.hpp"
#include "controller/held_lqr.hpp"
#include "controller/lqr_law.hpp"
#include "controller/mpc_engine.hpp"
#include "controller/whole_body_problem.hpp"
#include "solver/frequency_shaping.hpp"
#include "solver/horizon.hpp"

namespace ballbot {

struct MpcConfig {
  enum class Engine { kDiscrete, kContinuous };
  Engine engine = Engine::kDiscrete;
  Horizon horizon;
  int iterations = 1;            ///< per plan
  int first_iterations = 10;     ///< of a plan that starts from the LQR
  int threads = 1;               ///< the solver's; results are the same with 1 and 2
  bool solver_thread = false;    ///< solve beside the control loop: for real time, not repeatable
  bool contact_forces = false;   ///< the plan has end-effector forces as inputs
  bool contact_moments = false;  ///< and moments
  ContactSupervision contact_supervision;
  CommandLimits command_limits;
  SimDuration fallback_after = std::chrono::milliseconds(100);  ///< without a good plan
  FrequencyShaping shaping;
  Constraints constraints;
  TerminalCost terminal;
  ContinuousOptions continuous;
  std::shared_ptr<const TaskSchedule> schedule;
  /// Seeds the first plan, takes over when plans fail; weighs terminal.kind: lqr.
  LqrLawConfig lqr;
  PhaseClock clock = nullptr;

  explicit MpcConfig(const RobotParameters& robot);

  void describe(ConfigVisitor& v);
  /// Reads the `mpc` mapping. `lqr`, a mapping beside it, is read by whoever calls.
  static MpcConfig read(ConfigReader& in, const RobotParameters& robot);
};

/// @throw NumericalError as LqrLaw.
std::unique_ptr<MpcEngine> makeEngine(const RobotParameters& robot, const MpcConfig& config);

/// From a state to a plan: takes the previous plan as a guess where it is fresh, the LQR's policy
/// otherwise, and keeps what must survive from solve to solve. Solving neither allocates nor
/// throws.
class MpcPlanner {
 public:
  MpcPlanner(const RobotParameters& robot, const MpcConfig& config);

  MpcPolicy emptyPolicy() const { return engine_->emptyPolicy(); }

  /// @param xf        shaping filter state at `now`
  /// @param stand_in  the LQR's policy at `now`, a safe guess when there is none better
  /// @param previous  last good plan; may be invalid or stale
  /// @param out       the new plan where the report says accepted; else unspecified
  PlanReport plan(SimTime now, const StateVector& x, const Vector3& xf,
                  const JointVector& joint_angle, const PolicySample& stand_in,
                  const MpcPolicy& previous, MpcPolicy& out) noexcept;
  void setClock(PhaseClock clock) noexcept { engine_->setClock(clock); }

  /// What the plans that follow count on.
  void setCircumstances(const Circumstances& now) noexcept { circumstances_ = now; }

  /// What the planner makes of the contact; part of the state to be saved.
  const ContactSupervisor& contact() const noexcept { return supervisor_; }
  void setContact(const ContactSupervisor& supervisor) noexcept { supervisor_ = supervisor; }

  /// What the planner takes of commands that are far away; part of the state to be saved.
  const CommandGovernor& governor() const noexcept { return governor_; }
  void setGovernor(const CommandGovernor& governor) noexcept { governor_ = governor; }

  double shift() const noexcept { return engine_->shift(); }
  void setShift(double shift) noexcept { engine_->setShift(shift); }

 private:
  /// A guess where there is no plan: the LQR's policy, its gains those for the engine's steps.
  void seedFrom(const PolicySample& stand_in, SimTime now, double yaw) noexcept;
  /// Circumstances as they are to a robot in state x.
  PlanConditions conditionsAt(const StateVector& x) noexcept;
  /// What the governor lets through, to a robot in state x; after conditionsAt.
  GovernedCommands commandsAt(const StateVector& x, const LastingLoad& load) const noexcept;
  /// Tells the engine what to count on at the end-effector.
  ContactReport superviseContact(SimTime now, const Vector3& p_WE) noexcept;

  MpcConfig config_;
  ReducedDynamics dynamics_;
  ContactSupervisor supervisor_;
  CommandGovernor governor_;
  double known_payload_;  ///< [kg]
  Circumstances circumstances_;
  std::unique_ptr<MpcEngine> engine_;
  std::vector<FeedbackGain> seed_gains_;  ///< per control of the seed, at zero yaw
  MpcPolicy seed_;
};

}  // namespace ballbot
