#pragma once

#include "controller/circumstances.hpp"
#include "controller/cost_terms.hpp"
#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "model/state.hpp"
#include "solver/phase_clock.hpp"

namespace ballbot {

using FeedbackGain = Eigen::Matrix<double, kJointCount, kStateDim>;

/// What to do at one instant: tau = torque + feedback (x - x_ref), and set-points for joint PD.
struct PolicySample {
  StateVector x = StateVector::Zero();               ///< reference state x_ref
  JointVector torque = JointVector::Zero();          ///< feedforward [N m]
  FeedbackGain feedback = FeedbackGain::Zero();      ///< K, multiplies x - x_ref
  JointVector joint_position = JointVector::Zero();  ///< wheels: integrated along the plan [rad]
  JointVector joint_velocity = JointVector::Zero();  ///< [rad/s]
  bool from_stand_in = false;  ///< not the law itself: what acts for lack of a plan. Not saved

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.x);
    visit(self.torque);
    visit(self.feedback);
    visit(self.joint_position);
    visit(self.joint_velocity);
  }
};

/// What a plan counted on at the end-effector, for the record.
struct ContactReport {
  std::int8_t state = 0;                   ///< 0 none asked, 1 approach, 2 contact, 3 lost
  Vector3 asked_W = Vector3::Zero();       ///< force that the scenario asks for at its start [N]
  Vector3 counted_on_W = Vector3::Zero();  ///< what was made of it: limited, dropped, added to [N]
};

/// How a solve ended. The numbers stand in recorded plan reports.
enum class PlanStatus : int {
  kNothingToSolve = 0,  ///< the law has no solver
  kImproved = 1,
  kConverged = 2,  ///< nothing left to gain
  kNoDescent = 3,  ///< no step length lowered the cost
  kNotFinite = 4,  ///< the problem, or the last plan rolled out anew, is not finite
  kNotConvex = 5,
  kStateNotFinite = 6,  ///< the estimate it was to start from
};
const char* planStatusName(PlanStatus status);

/// What happened inside a plan() call, for the record.
struct PlanReport {
  bool accepted = true;  ///< false: the previous policy stays in force
  int iterations = 0;
  double cost = 0;
  double step_length = 0;
  double constraint_violation = 0;
  PlanStatus status = PlanStatus::kNothingToSolve;
  bool fallback = false;          ///< the law's simple stand-in is in force, for lack of a plan
  bool begun_anew = false;        ///< from the LQR, as the last plan led nowhere
  bool command_cut = false;       ///< less was planned for than a task asks at its start
  double predicted_decrease = 0;  ///< of the cost, by the quadratic model
  double regularisation = 0;      ///< added to the diagonal of the input Hessian
  CostTerms terms;                ///< the cost by task and barrier
  ContactReport contact;
  /// By the wall clock, if the law was given one. Not for any record that has to be the same twice.
  PhaseTimes times;
};

/// A balancing law: plans at its own period, is sampled at the tracker's.
class ControlLaw {
 public:
  virtual ~ControlLaw() = default;

  /// Plans from the estimate `x` and the measured joint angles, both of time `now`. The plan is
  /// stamped with `now`; who calls decides from when on it may act (computation latency).
  virtual PlanReport plan(SimTime now, const StateVector& x,
                          const JointVector& joint_angle) noexcept = 0;

  /// What the next plan() counts on beside the state.
  virtual void setCircumstances(const Circumstances& now) noexcept { (void)now; }

  /// Has the phases of each plan timed.
  virtual void setClock(PhaseClock clock) noexcept { (void)clock; }

  /// Makes the newest plan the one that sample() uses.
  virtual void activatePlan() noexcept = 0;

  /// The policy in force at `now`. Never allocates, locks or throws.
  virtual void sample(SimTime now, PolicySample& out) const noexcept = 0;

  /// Tells the law what torque is commanded from `now` for `period` (frequency-shaping filters are
  /// driven by it). Called at every tracker tick.
  virtual void commanded(SimTime now, SimDuration period, const JointVector& torque) noexcept = 0;

  virtual StateBlob saveState() const = 0;
  virtual void restoreState(const StateBlob& blob) = 0;
};

}  // namespace ballbot
