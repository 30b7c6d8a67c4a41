#pragma once

#include "model/state.hpp"

namespace ballbot {

class ConfigVisitor;

/// A ball that gives way on a level floor, after Hunt and Crossley (1975), with their damping that
/// grows from nothing at touch and so makes no jump there:
///
///   f = max(0, k x^(3/2) (1 + 3/2 c dx))        x depth, dx its rate
///   friction  -mu f tanh(s / s0) along the slip velocity s of the ball's lowest point
///   spin torque  -lever f tanh(spin / spin0) about the vertical
///
/// Friction is regularised: under a steady load F the ball creeps at s0 atanh(F / (mu f)).
struct FloorContactParameters {
  double stiffness = 2.2e7;     ///< k [N/m^1.5]; the robot stands half a millimetre deep
  double dissipation = 0.5;     ///< c [s/m]; at an impact speed v it rebounds with about 1 - c v
  double friction = 0.8;        ///< mu
  double slip_velocity = 0.01;  ///< s0 [m/s]

  void describe(ConfigVisitor& v);
};

/// Force and torque of the floor on a ball, about its centre, in W [N, N m].
struct FloorLoad {
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
};

class FloorContact {
 public:
  /// @param spin_smoothing  spin at which three quarters of the spin torque are reached [rad/s]
  FloorContact(const FloorContactParameters& p, double radius, double spin_smoothing)
      : p_(p), radius_(radius), spin_smoothing_(spin_smoothing) {}

  /// @param height  of the ball's centre above the floor [m]
  /// @param spin_lever  largest torque about the vertical per normal force [m]
  FloorLoad load(double height, const Vector3& v_WK_W, const Vector3& w_WK_W,
                 double spin_lever) const;
  /// Depth at which the floor carries `weight` [N]: (weight / k)^(2/3) [m].
  double restingDepth(double weight) const;
  /// Of the deformation [J]: 2/5 k x^(5/2).
  double energy(double height) const;

 private:
  FloorContactParameters p_;
  double radius_, spin_smoothing_;
};

}  // namespace ballbot
