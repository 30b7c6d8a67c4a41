#pragma once

#include "model/omniwheel_kinematics.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

/// Forces of the ball on its wheels [N].
struct WheelLoads {
  Vector3 normal;    ///< along the contacts' normals c_i; below zero a wheel would lift off
  Vector3 traction;  ///< along their directions of driving, c_i x d_i
};

/// What the wheels of the robot of ReducedDynamics bear while nothing slips. All that stands on the
/// ball is carried by three normal forces and three tractions; a wheel's traction is what speeds it
/// up beyond its torque:
///
///   sum_i N_i c_i + T_i t_i = sum_b m_b (a_b - g) - applied,   r_w T_i = I_w (d.dw + ddphi)_i -
///   tau_i
///
/// across t_i the rollers roll freely. Const and free of allocation: may run in the control step.
class WheelLoadModel {
 public:
  explicit WheelLoadModel(const RobotParameters& robot);

  /// @param dnu  acceleration with which the robot moves
  /// @param wheel_torque  [N m]
  /// @param applied_W  other forces on what stands on the ball, their sum in W [N]
  WheelLoads at(const StateVector& x, const VelocityVector& dnu, const Vector3& wheel_torque,
                const Vector3& applied_W) const;

 private:
  RobotParameters robot_;
  OmniwheelKinematics kinematics_;
  BodyInertia base_, last_link_;
  Matrix3 axles_;          ///< rows d_i
  Matrix3 tangents_;       ///< columns t_i
  Matrix3 along_normals_;  ///< components of a force in B along the three c_i
};

}  // namespace ballbot
