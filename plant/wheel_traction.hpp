#pragma once

#include <limits>

#include "model/state.hpp"

namespace ballbot {

class ConfigVisitor;

/// Friction between wheels and ball where they may slip (plant.fidelity.wheels: slipping).
struct WheelContactParameters {
  double friction = 0.8;  ///< largest force along the wheel's direction per normal force
  double creep = 5e-5;    ///< slip velocity per such force, below the largest [m/s per N]
  /// Normal force and traction go on record where wheels roll, too.
  bool recorded = false;

  void describe(ConfigVisitor& v);
};

/// The wheels on the ball, each along its contact's normal and its direction of driving.
struct WheelContacts {
  Vector3 normal_force = Vector3::Zero();  ///< ball on wheel; below zero it would lift off [N]
  Vector3 traction = Vector3::Zero();      ///< ball on wheel, along c_i x d_i [N]
  Vector3 slip = Vector3::Zero();          ///< of the rim against the ball [m/s]

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.normal_force);
    visit(self.traction);
    visit(self.slip);
  }
};

/// Torques lambda of the contacts on the wheels' own axles, at one instant, as linear relations:
///
///   rate of slip        d(slip) = A lambda - wanted   [rad/s^2]
///   normal force        N = N_free + N_torque lambda  [N]
///
/// A wheel that cannot slip has lambda such that d(slip) = 0. One that can lets its slip and creep
/// fade within `fade_s` instead, d(slip) = -(slip + creep lambda) / fade_s, so that without change
/// it creeps at -creep lambda; but |lambda| is at most its limit, and at most
/// friction_lever N. What is beyond accelerates the wheel. Continuous, and stiff no more than
/// 1 / fade_s: an explicit integrator can have it whatever the wheel's inertia.
struct TractionProblem {
  Matrix3 A = Matrix3::Zero();
  Vector3 wanted = Vector3::Zero();
  Vector3 slip = Vector3::Zero();      ///< [rad/s]
  Vector3 N_free = Vector3::Zero();    ///< [N]
  Matrix3 N_torque = Matrix3::Zero();  ///< [1/m]

  double fade_s = 0;
  double creep = 0;  ///< [rad/s per N m]
  /// Friction times the wheel's radius; infinite where the normal force does not matter [m].
  double friction_lever = std::numeric_limits<double>::infinity();
  Vector3 limit = Vector3::Constant(std::numeric_limits<double>::infinity());  ///< [N m]

  bool canSlip(int wheel) const;
  Vector3 normalForce(const Vector3& lambda) const { return N_free + N_torque * lambda; }
};

/// Those torques. Which wheels slide or lift is found one by one, the one that is furthest from
/// what it was taken to do first.
Vector3 solveTraction(const TractionProblem& problem);

}  // namespace ballbot
