#pragma once

// Includes Simbody: for multibody_*.cpp, turning_bodies.* and robot_tree.cpp only.
#include <array>

#include <Simbody.h>

#include "plant/multibody.hpp"
#include "plant/wheel_rolling.hpp"

namespace ballbot {

inline SimTK::Vec3 toSimTK(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
inline Vector3 toEigen(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }
Matrix3 toEigen(const SimTK::Rotation& R);

/// @throw InputError naming the body if this cannot be the inertia of a rigid body.
SimTK::Body toBody(const BodyInertia& inertia, const std::string& name);

/// Frame whose z axis is `axis`, at `p`: what a pin joint turns about.
SimTK::Transform pinFrame(const Vector3& axis, const Vector3& p);

/// The joint of an arm link, its coordinate the joint's angle.
SimTK::MobilizedBody armJoint(SimTK::MobilizedBody& parent, const ArmLink& link,
                              const SimTK::Body& body);

/// `whole` without `part`, whose origin is at p_WP in whole's frame; axes are parallel.
BodyInertia without(const BodyInertia& whole, BodyInertia part, const Vector3& p_WP);

/// The bodies that both structures share: carriage (the ball as it rolls), base and three arm
/// links. Their coordinates are the first of Simbody's q and u:
///
///   q = (px, py | quaternion of R_WB | arm angles | ball spin angle, if it can | ...)
///   u = (vx, vy | w_WB_W | arm rates | ball spin, if it can | what the structure adds)
///
/// Rolling without slip ties the horizontal part of the ball's angular velocity to its velocity, so
/// ball and carriage are one point of mass m_K + I_K / r^2 (exact on a level floor). With ball spin
/// that point is the origin of a body that turns about the vertical with I_K.
class RobotTree {
 public:
  /// base and links may differ from the robot's: the structures put wheels and rotors in or out.
  /// Gravity acts on the robot's, wheels and rotors being where their carriers are.
  RobotTree(const RobotParameters& robot, const BodyInertia& base,
            const std::array<BodyInertia, kArmJointCount>& links, bool ball_spin);

  /// To be called once, after further bodies were added.
  void finishTopology();

  /// Puts q and u into the state and realizes it to Stage::Velocity, unless it is there already.
  void realize(const double* q, const double* u);

  const BaseMotion& base() const { return base_motion_; }
  const BodyMotion& body(BodyIndex body) const { return motion_[body]; }
  const SimTK::MobilizedBody& mobilizedBody(BodyIndex body) const { return bodies_[body]; }

  /// Gravity and loads.forces as Simbody wants them: one spatial force per body in bodyForces(),
  /// the ball's part and the arm torques in mobilityForces(). Overwrites both.
  void collectForces(const MultibodyLoads& loads);
  void addTorque(BodyIndex body, const Vector3& torque_W);
  SimTK::Vector& mobilityForces() { return mobility_forces_; }
  SimTK::Vector_<SimTK::SpatialVec>& bodyForces() { return body_forces_; }

  /// q and u at rest in the given pose; only the shared coordinates are written.
  void place(const RobotPose& pose, double* q, double* u) const;
  void setVelocity(const double* q, const VelocityVector& nu, double ball_spin, double* u) const;
  Matrix3 rotationFromQ(const double* q) const;
  void normalizeQuaternion(double* q) const;

  /// What the ball carries, as a force on it, in W: what stands on it at the accelerations that
  /// Simbody gave for its bodies, less the loads that act there [N].
  Vector3 carriedLoad(const MultibodyLoads& loads,
                      const SimTK::Vector_<SimTK::SpatialVec>& body_acceleration) const;
  /// Momentum of all but the ball at shared velocities u; of accelerations, its rate but for what
  /// is quadratic in velocities [N s].
  Vector3 carriedMomentum(const double* u) const;

  double kineticEnergy() const { return matter.calcKineticEnergy(state); }
  double potentialEnergy() const;

  int nq() const { return nq_; }
  int nu() const { return nu_; }
  /// How many of q and u are shared.
  int sharedQ() const { return ball_spin_ ? kSharedDim + 1 : kSharedDim; }
  int sharedU() const { return ball_spin_ ? kSharedDim : kSharedDim - 1; }
  static constexpr int kQuaternionQ = 2, kArmQ = 6;

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::State state;

 private:
  double ball_radius_, gravity_;
  bool ball_spin_;
  int nq_ = 0, nu_ = 0;
  std::array<SimTK::MobilizedBody, kBodyCount> bodies_;
  std::array<SimTK::MobilizedBodyIndex, kBodyCount> index_;
  struct Weight {
    double mass = 0;
    Vector3 p_LLcm_L = Vector3::Zero();
  };
  std::array<Weight, kBodyCount> weight_;         ///< wheels and rotors with their carrier
  std::array<Vector3, kArmJointCount> arm_axis_;  ///< in the link's own axes; or its way per angle
  std::array<bool, kArmJointCount> arm_slides_;
  std::array<BodyMotion, kBodyCount> motion_;
  BaseMotion base_motion_;
  SimTK::Vector mobility_forces_;
  SimTK::Vector_<SimTK::SpatialVec> body_forces_;
  bool realized_ = false;
};

}  // namespace ballbot
