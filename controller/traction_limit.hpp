#pragma once

#include "core/config_visitor.hpp"
#include "model/reduced_dynamics.hpp"
#include "model/wheel_flags.hpp"
#include "model/wheel_loads.hpp"

namespace ballbot {

/// What is made of the friction between wheels and ball that the robot's description gives
/// (robot.wheels.friction).
struct TractionBelief {
  bool limited = true;          ///< false: wheels hold whatever they are asked for
  double command_share = 0.85;  ///< of what friction holds, what is commanded at most
  /// A wheel that bears less is still asked for what friction holds at so much, for the estimate of
  /// what it bears is not that good [N].
  double least_normal = 15;

  void describe(ConfigVisitor& v);
};

/// The last word on the wheels' torques: none is asked for more traction than friction holds at the
/// normal force that the torques themselves bring about. What one is denied the two others take, so
/// that the ball is driven as it was to be: about the vertical it gives way, for balance goes
/// first. Free of allocation; for the control step.
class TractionLimit {
 public:
  TractionLimit(const RobotParameters& robot, const TractionBelief& belief);

  /// Whether there is anything to be kept.
  bool acts() const noexcept { return acts_; }

  /// @param push  force on the robot that the model does not have, in the rows of nu [N, N m]
  /// @param spin_torque  that the floor holds; kUnlimited without end [N m]
  /// @return whether it changed anything
  bool cut(const StateVector& x, const VelocityVector& push, double spin_torque,
           JointVector& torque) const noexcept;

  /// Of wheels that slip, those for which that is no wonder: they bear little, or friction gives
  /// them about what it can. Others slip on something.
  /// @param torque  at the joints [N m], @param grip  what friction gives each wheel [N m]
  WheelFlags overloaded(const StateVector& x, const VelocityVector& push, const JointVector& torque,
                        const Vector3& grip) const noexcept;

 private:
  /// Torque that friction of a wheel holds on its own axle at that normal force [N m].
  double held(double normal) const noexcept;
  WheelLoads loads(const StateVector& x, const VelocityVector& push,
                   const JointVector& torque) const noexcept;

  TractionBelief belief_;
  ReducedDynamics dynamics_;
  WheelLoadModel model_;
  OmniwheelKinematics kinematics_;
  double lever_;  ///< friction times radius of a wheel [m]
  double wheel_radius_, torque_limit_;
  double normal_at_rest_;  ///< of each wheel [N]
  bool acts_;
};

}  // namespace ballbot
