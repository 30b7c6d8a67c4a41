#pragma once

#include "controller/control_law.hpp"
#include "model/reduced_dynamics.hpp"
#include "model/wheel_flags.hpp"

namespace ballbot {

class ConfigVisitor;

/// Quadratic weights of the balancing law, L = 1/2 (dx^T Q dx + dtau^T R dtau), one number per kind
/// of coordinate: Q and R are diagonal. Wheels and arm have weights of their own because their
/// drives carry different loads.
struct LqrWeights {
  double ball_position = 20;  ///< px, py [1/m^2]
  double yaw = 10;            ///< [1/rad^2]
  double tilt = 0;            ///< pitch, roll [1/rad^2]
  double arm_position = 50;   ///< [1/rad^2]
  double ball_velocity = 10;  ///< [s^2/m^2]
  double base_rate = 4;       ///< w_WB_B [s^2/rad^2]
  double arm_rate = 0.5;      ///< [s^2/rad^2]
  double wheel_torque = 2;    ///< [1/(N m)^2]
  double arm_torque = 0.5;    ///< [1/(N m)^2]

  StateJacobian stateWeight() const;                           ///< Q
  Eigen::Matrix<double, kJointCount, 1> torqueWeight() const;  ///< diagonal of R

  void describe(ConfigVisitor& v);
};

/// Infinite-horizon optimal state feedback about an equilibrium: tau = tau_eq + K (x - x_eq), and
/// the value 1/2 (x - x_eq)^T P (x - x_eq) of starting from x.
struct LqrSolution {
  Equilibrium equilibrium;  ///< px = py = yaw = 0
  FeedbackGain K;
  StateJacobian P;
};

/// LQR about the equilibrium with the arm at `arm` [rad]; joints of a rigid arm take no part in it.
/// @param lost  wheels whose torque moves nothing, one at most: its row of the gain is zero, and so
///              are the columns of yaw and its rate, with which two wheels cannot be charged as
///              well
/// @throw NumericalError if there is no such equilibrium or no stabilising gain.
LqrSolution designLqr(const ReducedDynamics& dynamics, const ArmVector& arm,
                      const LqrWeights& weights, const WheelFlags& lost = {});

/// The gain for a robot that faces `yaw`: the dynamics know no direction in the plane, so the
/// errors of ball position and velocity, given in W, only have to be turned into the heading.
FeedbackGain gainAtYaw(const FeedbackGain& K, double yaw);

}  // namespace ballbot
