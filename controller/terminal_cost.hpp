#pragma once

#include <memory>

#include "controller/lqr.hpp"
#include "controller/mpc_dimensions.hpp"
#include "controller/tasks.hpp"
#include "solver/riccati.hpp"

namespace ballbot {

class ConfigVisitor;

/// What happens after the horizon, as a cost of its last state.
struct TerminalCost {
  enum class Kind {
    kScaledState,  ///< the state's cost rate times state_scale
    kLqr,          ///< the value of balancing on from there by the LQR, times lqr_scale
  };
  Kind kind = Kind::kScaledState;
  double state_scale = 0.5;  ///< [s]
  double lqr_scale = 1;
  LqrWeights lqr_weights;  ///< of the LQR, from its own section

  void describe(ConfigVisitor& v);
  double stateScale() const { return kind == Kind::kScaledState ? state_scale : 0; }
};

/// The LQR's value 1/2 e^T P e as a cost, e the distance from the rest the tasks ask for: at the
/// yaw and arm pose they name, and with the ball at its reference or, where only the end-effector
/// has a place to be, where the end-effector then stands right. What no task names is no error.
class LqrTerminalCost {
 public:
  /// @throw NumericalError as designLqr.
  LqrTerminalCost(const RobotParameters& robot, const TerminalCost& terminal);

  double value(const StateVector& x, const Tasks& tasks) const noexcept;
  /// value(), adding its expansion, which is exact, to `out`.
  double expand(const StateVector& x, const Tasks& tasks,
                ValueFunction<kMpcStateDim>& out) const noexcept;

 private:
  /// The error; components that are none are zero, and so is their place in `counts`.
  StateVector error(const StateVector& x, const Tasks& tasks, StateVector& counts) const noexcept;
  StateJacobian weight(const Tasks& tasks, const StateVector& counts) const noexcept;

  LqrSolution lqr_;
  Eigen::Vector2d p_KE_;  ///< horizontal, of the end-effector at rest, at zero yaw [m]
  double scale_;
};

}  // namespace ballbot
