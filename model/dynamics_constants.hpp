#pragma once

#include <array>

#include "model/robot_parameters.hpp"

namespace ballbot {

/// RobotParameters in the form the equations of motion use, computed once.
struct DynamicsConstants {
  explicit DynamicsConstants(const RobotParameters& robot);

  struct Link {
    Vector3 p_PJ_P;  ///< joint origin in the parent's frame [m]
    Vector3 axis;    ///< unit vector, the same in parent and link; of one that slides its
                     ///< way per angle [m/rad]
    bool slides;
    Vector3 com;               ///< centre of mass from the joint [m]
    Matrix3 second_moment_cm;  ///< sum of m p p^T about the centre of mass [kg m^2]
    double mass;
  };
  std::array<Link, kArmJointCount> arm;  ///< the last one with its payload
  /// The arm's links have neither mass nor inertia: its joints have no equations of motion, and
  /// stay as they are.
  bool rigid_arm;
  Vector3 p_A3E;
  Matrix3 R_A3E;

  double base_mass;            ///< wheels included
  Vector3 base_first_moment;   ///< about K [kg m]
  Matrix3 base_second_moment;  ///< about K [kg m^2]

  double gravity, ball_radius;
  double total_mass;     ///< of the whole robot [kg]
  double rolling_mass;   ///< ball mass plus I_ball / r^2: its inertia against rolling [kg]
  double ratio;          ///< rho = r / r_w
  Matrix3 axles;         ///< D, rows d_i
  Matrix3 spin_inertia;  ///< G = I_w sum of d_i d_i^T [kg m^2]
  double ball_inertia;   ///< I_ball, about any axis [kg m^2]
};

}  // namespace ballbot
