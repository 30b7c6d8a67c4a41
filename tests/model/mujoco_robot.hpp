#pragma once

#include <memory>

#include "model/robot_parameters.hpp"
#include "model/spinning_state.hpp"

namespace ballbot {

/// The robot in MuJoCo with nothing that holds its parts together but hinges: ball and base are
/// free bodies, wheels and arm hang on the base, gravity acts. Rolling is imposed here by
/// projection onto the 8 velocities of model/state.hpp, or onto those and the ball's spin; of
/// model/ only the parameters are used.
class MujocoRobot {
 public:
  explicit MujocoRobot(const RobotParameters& robot);
  ~MujocoRobot();

  /// dnu/dt for given torques and a force at the end-effector, in W.
  VelocityVector acceleration(const PositionVector& q, const VelocityVector& nu,
                              const JointVector& tau, const Vector3& lambda_W);

  /// The same for a ball that may spin, with a torque of the floor on it about the vertical.
  SpinningVelocityVector acceleration(const PositionVector& q, const SpinningVelocityVector& nu,
                                      const JointVector& tau, const Vector3& lambda_W,
                                      double floor_torque);

  /// End-effector position in W at the state of the last call.
  Vector3 endEffectorPosition() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ballbot
