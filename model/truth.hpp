#pragma once

#include "core/time.hpp"
#include "model/state.hpp"

namespace ballbot {

/// Whether the end-effector touches something, and holds on to it or slides along it.
enum class ContactPhase { kNone, kSticking, kSliding };

/// The plant's true state, recorded for people and for judging a run. No file of controller/ or
/// estimator/ may include this header (a test holds that): a controller that knows the truth
/// proves nothing.
struct TruthFrame {
  SimTime time{};
  StateVector state = StateVector::Zero();  ///< (q, nu) as in model/state.hpp
  JointVector joint_angle =
      JointVector::Zero();  ///< wheels: integrated angle relative to the base [rad]
  JointVector joint_velocity = JointVector::Zero();  ///< [rad/s]
  JointVector motor_angle = JointVector::Zero();     ///< behind the gear, before the spring [rad]
  JointVector joint_torque =
      JointVector::Zero();              ///< torque the spring (or ideal actuator) applies [N m]
  Vector3 p_WE = Vector3::Zero();       ///< end-effector position in W [m]
  Eigen::Vector4d quat_WE{1, 0, 0, 0};  ///< end-effector orientation, w x y z
  Vector3 external_force_W = Vector3::Zero();  ///< sum of scheduled pushes [N]
  Vector3 contact_force_W = Vector3::Zero();   ///< environment on the end-effector [N]
  Vector3 contact_point_W = Vector3::Zero();   ///< where it acts; without contact p_WE [m]
  ContactPhase contact_phase = ContactPhase::kNone;
  double door_angle = 0;  ///< from closed; 0 without a door [rad]
  double door_rate = 0;   ///< [rad/s]
};

}  // namespace ballbot
