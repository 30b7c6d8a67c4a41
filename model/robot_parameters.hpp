#pragma once

#include <array>
#include <string>

#include "model/limits.hpp"
#include "model/state.hpp"

namespace ballbot {

/// Mass properties of a rigid body L in its own frame.
struct BodyInertia {
  double mass = 0;                     ///< [kg]
  Vector3 p_LLcm_L = Vector3::Zero();  ///< centre of mass from the body's origin [m]
  Matrix3 I_LLcm_L = Matrix3::Zero();  ///< about the centre of mass, axes of L [kg m^2]
};

/// `a` and `b` rigidly joined; both given in frames with parallel axes, b's origin at p_AB_A.
BodyInertia composed(const BodyInertia& a, const BodyInertia& b, const Vector3& p_AB_A);

/// One joint of the arm and the link it carries. At zero angles all link frames are parallel to B.
/// A joint that slides is driven by a pinion on a rack, or a screw, and counts by the angle of
/// that: its angles, rates and torques are the drive's, as of any other joint.
struct ArmLink {
  std::string name;
  Vector3 p_PJ_P =
      Vector3::Zero();  ///< joint origin at zero in the parent's frame (base: from K) [m]
  Vector3 axis = Vector3::UnitZ();          ///< unit vector, same in parent and link
  BodyInertia inertia;                      ///< origin at the joint
  double lower_limit = 0, upper_limit = 0;  ///< [rad]; see limits.hpp
  double lead = 0;  ///< of a joint that slides: its way along the axis per angle [m/rad]; else 0

  bool slides() const { return lead > 0; }
  Vector3 slide() const { return lead * axis; }  ///< way per angle [m/rad]
};

/// Rigid-body parameters of the robot: what plant, estimator and controller agree on.
/// Mass data comes from the URDF, the rest from the YAML beside it.
struct RobotParameters {
  std::string name;
  double gravity = 9.81;  ///< [m/s^2]

  struct Ball {
    double radius = 0;   ///< [m]
    double mass = 0;     ///< [kg]
    double inertia = 0;  ///< about any axis through its centre [kg m^2]
  } ball;

  /// Three equal omni wheels. Contact with the ball in direction c_i from K, axle d_i, both in B.
  struct Wheels {
    double radius = 0;                          ///< [m]
    double mass = 0;                            ///< each [kg]
    double spin_inertia = 0;                    ///< about the axle [kg m^2]
    double transverse_inertia = 0;              ///< about any axis across the axle [kg m^2]
    double contact_zenith = 0;                  ///< angle of the contact from the ball's top [rad]
    std::array<double, kWheelCount> azimuth{};  ///< [rad]
    /// Largest force along the direction of driving per normal force; kUnlimited: nobody said.
    double friction = kUnlimited;
  } wheels;

  BodyInertia base;  ///< without wheels, origin at K
  std::array<ArmLink, kArmJointCount> arm;

  Vector3 p_A3E = Vector3::Zero();      ///< end-effector frame E in the last link [m]
  Matrix3 R_A3E = Matrix3::Identity();  ///< takes E coordinates to the last link's

  Vector3 p_BI_B = Vector3::Zero();  ///< IMU from the base origin (= K) [m]

  /// A point mass carried at E, known to the model; zero when nothing is carried [kg].
  double payload_mass = 0;

  ArmVector nominal_arm = ArmVector::Zero();  ///< arm pose to start from and to balance about [rad]
  double wheel_torque_limit = 0;              ///< what traction allows [N m]
  double arm_torque_limit = 0;                ///< [N m]
  double wheel_speed_limit = kUnlimited;  ///< of a wheel relative to the base, by its drive [rad/s]

  /// Direction of contact i from K, in B (unit).
  Vector3 contactDirection(int i) const;
  /// Axle of wheel i, in B (unit), pointing outward and down; positive spin by the right hand.
  Vector3 wheelAxle(int i) const;
  /// Wheel centre of wheel i from K, in B [m].
  Vector3 wheelCentre(int i) const;
  /// Base with the three wheels welded on, less the spin inertia about each axle, which the
  /// dynamics add by rate. Origin at K.
  BodyInertia baseWithWheels() const;
  /// Last link with the payload. Origin at joint 3.
  BodyInertia lastLinkWithPayload() const;
  double totalMass() const;
};

}  // namespace ballbot
