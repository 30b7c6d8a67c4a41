#pragma once

#include "controller/constraints.hpp"
#include "controller/cost_terms.hpp"
#include "controller/mpc_dimensions.hpp"
#include "model/robot_parameters.hpp"
#include "solver/riccati.hpp"

namespace ballbot {

/// Torque of the wheels on the ball about the vertical. The model holds the ball's spin at zero,
/// and so counts on the floor to return all of it; a real floor returns what friction under the
/// ball can hold. With T = -(r/r_w) D^T tau, D the wheels' axles as rows:
///
///   (R_WB T)_z = c(x) . tau,   c = -(r/r_w) D R_WB^T z
///
/// less the part that only speeds up the wheels, which is small and left out.
class SpinTorque {
 public:
  explicit SpinTorque(const RobotParameters& robot);

  struct PerWheel {
    Vector3 c;                  ///< N m about the vertical per N m of each wheel
    Vector3 by_pitch, by_roll;  ///< derivatives of c
  };
  PerWheel at(const StateVector& x) const noexcept;

  /// The torques of the wheels nearest to `tau` with |c . tau| <= limit: what balances the robot
  /// is across c when it stands upright, so it is yaw that gives way.
  Vector3 within(double limit, const StateVector& x, const Vector3& tau) const noexcept;
  /// The same for what is commanded.
  void cut(double limit, const StateVector& x, JointVector& torque) const noexcept;

 private:
  Matrix3 scaled_axles_;  ///< -(r/r_w) D
};

/// Barriers at both limits, zero without torque: value times `share`.
double spinTorqueCost(const SpinTorque& spin, const Constraints& limits, const StateVector& x,
                      const Vector3& tau, double share, double& violation) noexcept;

/// The second-order expansion of that in state and inputs, whose cross terms P it sets and whose
/// others it adds to; of the constraint's own curvature nothing, so that it stays positive
/// semidefinite.
template <int NU>
void expandSpinTorqueCost(const SpinTorque& spin, const Constraints& limits, const StateVector& x,
                          const Vector3& tau, double share, LqStage<kMpcStateDim, NU>& lq) noexcept;

}  // namespace ballbot
