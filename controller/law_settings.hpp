#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "controller/constraints.hpp"
#include "controller/control_law.hpp"
#include "model/added_signals.hpp"
#include "model/motion_reference.hpp"
#include "model/reduced_dynamics.hpp"
#include "model/robot_parameters.hpp"
#include "solver/frequency_shaping.hpp"

namespace ballbot {

/// Quadratic cost about an equilibrium that a law minimises.
struct QuadraticCost {
  StateJacobian Q;  ///< of the state's error
  JointVector R;    ///< diagonal, of the torques at frequency zero [1/(N m)^2]
  FrequencyShaping shaping;
};

/// What was read of a law: makes it, and says what those who judge, draw or analyse a run want to
/// know of it.
class LawSettings {
 public:
  /// @param robot  as the controller believes it to be
  explicit LawSettings(const RobotParameters& robot) : robot_(robot) {}
  virtual ~LawSettings() = default;

  /// @throw NumericalError if no such law balances this robot.
  virtual std::unique_ptr<ControlLaw> makeLaw() const = 0;
  /// The law as it would be at time `at` for good, asked to stand where the robot is at rest with
  /// its arm in the nominal pose, and solved where plan() is called: what can be differentiated.
  virtual std::unique_ptr<ControlLaw> makeLawAtRest(SimTime at) const {
    (void)at;
    return makeLaw();
  }

  virtual std::shared_ptr<const MotionReference> reference() const {
    return std::make_shared<MotionReference>();
  }
  /// What the robot should stay within.
  virtual Constraints limits() const { return Constraints(robot_); }
  /// What it minimises at time `at` with the arm at rest in a pose [rad]; nothing where it is no
  /// law of that kind, and its loop cannot be analysed.
  virtual std::optional<QuadraticCost> costAt(SimTime at, const ArmVector& arm) const {
    (void)at, (void)arm;
    return std::nullopt;
  }
  /// What it records of each plan beside the common report: names of PlanReport::terms.added.
  virtual std::vector<AddedSignal> addedToPlan() const { return {}; }
  /// Its settings have a `wheel_shaping`, to be matched to drives.
  virtual bool shapesWheelTorques() const { return false; }
  /// A plan is made every `period`, and acts `latency` later.
  /// @throw InputError if the law cannot work so.
  virtual void requireRates(SimDuration period, SimDuration latency) const {
    (void)period, (void)latency;
  }

  const RobotParameters& robot() const { return robot_; }

 private:
  RobotParameters robot_;
};

}  // namespace ballbot
