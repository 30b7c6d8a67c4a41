#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "model/robot_parameters.hpp"
#include "model/state.hpp"
#include "plant/floor_contact.hpp"
#include "plant/wheel_traction.hpp"

namespace ballbot {

/// How the robot is cut into bodies. Both are exact for the same robot and agree to rounding.
enum class MultibodyStructure {
  kFull,          ///< "R": wheels and rotors are bodies, rolling is a constraint
  kReducedWheels  ///< "M": wheels and rotors are axisymmetric gyrostats without bodies of their own
};

struct MultibodyOptions {
  MultibodyStructure structure = MultibodyStructure::kFull;
  /// Rotor of each actuator, with its inertia [kg m^2, motor side] and gear ratio. Without rotors
  /// the joint torques act directly between the bodies.
  bool rotors = true;
  JointVector rotor_inertia = JointVector::Constant(4e-5);
  JointVector gear_ratio = JointVector::Constant(50);
  /// The ball may spin about the vertical: a third degree of freedom of the ball.
  bool ball_spin = false;
  /// The ball lies on a floor that gives way, instead of rolling on a rigid one: it has all of its
  /// six degrees of freedom. Needs error-controlled integration.
  std::optional<FloorContactParameters> floor;
  double spin_smoothing = 0.02;  ///< of such a floor [rad/s]
  /// The wheels slip where their normal force holds them no longer, and creep where it does.
  std::optional<WheelContactParameters> wheel_slip;
  double slip_fade_s = 1e-3;    ///< within which such a wheel, or one with a fault, grips again
  bool wheel_contacts = false;  ///< wheelContacts() is asked for
};

/// Bodies an external force can act on.
enum BodyIndex : int { kBallBody, kBaseBody, kLink1Body };  ///< and the arm's others
constexpr int kBodyCount = kLink1Body + kArmJointCount;
/// Body i of the arm, from 0; the last carries the end-effector.
constexpr BodyIndex armBody(int i) { return static_cast<BodyIndex>(kLink1Body + i); }
constexpr BodyIndex kHandBody = armBody(kArmJointCount - 1);

/// A force on a body. The ball is isotropic and its orientation is not followed, so a point of the
/// ball is given from its centre along the axes of W.
struct PointForce {
  BodyIndex body;
  Vector3 p_BP_B;   ///< point of application from the body's origin, in its axes [m]
  Vector3 force_W;  ///< [N]
};

/// Everything that acts on the robot at one instant, gravity apart.
struct MultibodyLoads {
  JointVector joint_torque = JointVector::Zero();  ///< on the joint, reaction on its parent [N m]
  JointVector rotor_torque = JointVector::Zero();  ///< on the rotor, times the gear ratio [N m]
  double ball_spin_torque = 0;                     ///< on the ball about the vertical [N m]
  double spin_lever = 0;           ///< the same per load, at most, of a floor that gives way [m]
  std::vector<PointForce> forces;  ///< keeps its capacity between uses
};

/// Angles and rates at the six actuators; wheels relative to the base.
struct JointMotion {
  JointVector angle = JointVector::Zero();           ///< [rad]
  JointVector velocity = JointVector::Zero();        ///< [rad/s]
  JointVector rotor_angle = JointVector::Zero();     ///< divided by the gear ratio [rad]
  JointVector rotor_velocity = JointVector::Zero();  ///< divided by the gear ratio [rad/s]
};

/// Motion of the ball centre K and of the base, which has its origin there.
struct BaseMotion {
  Vector3 p_WK = Vector3::Zero();  ///< [m]
  Matrix3 R_WB = Matrix3::Identity();
  Vector3 v_WK_W = Vector3::Zero();  ///< [m/s]
  Vector3 w_WB_W = Vector3::Zero();  ///< [rad/s]
  double ball_spin = 0;              ///< of the ball about the vertical [rad/s]
};

/// Acceleration of the same.
struct BaseAcceleration {
  Vector3 a_WK_W = Vector3::Zero();      ///< [m/s^2]
  Vector3 alpha_WB_W = Vector3::Zero();  ///< [rad/s^2]
};

/// Acceleration of joints and rotors, the latter divided by the gear ratio [rad/s^2].
struct JointAcceleration {
  JointVector joint = JointVector::Zero();
  JointVector rotor = JointVector::Zero();
};

/// Where a body is and how it moves, of its origin. The ball's orientation is not followed: its
/// axes are those of W.
struct BodyMotion {
  Vector3 p_WL = Vector3::Zero();
  Matrix3 R_WL = Matrix3::Identity();
  Vector3 v_WL_W = Vector3::Zero();
  Vector3 w_WL_W = Vector3::Zero();
};

/// Pose the robot is put in, at rest.
struct RobotPose {
  double px = 0, py = 0;                ///< of K [m]
  double yaw = 0, pitch = 0, roll = 0;  ///< [rad]
  ArmVector arm = ArmVector::Zero();    ///< [rad]
};

/// The robot's rigid bodies on a ball that rolls on a level floor without slip, or lies on one that
/// gives way, as an ordinary differential equation dy/dt = f(y, loads). y holds all coordinates and
/// velocities; its layout is the structure's own. Not thread safe; a value of y means the same in
/// every instance built with the same parameters.
class Multibody {
 public:
  virtual ~Multibody() = default;

  /// Length of y.
  virtual int stateDim() const = 0;
  /// y at rest in the given pose, wheels and rotors at angle zero, rotors of the arm at its angles.
  virtual void place(const RobotPose& pose, double* y) const = 0;
  /// Sets the velocities of y from those of the whole-body state; rotors turn with their joints.
  virtual void setVelocity(const VelocityVector& nu, double ball_spin, double* y) const = 0;

  /// Takes y as the current state. Everything below refers to it.
  virtual void realize(const double* y) = 0;
  virtual JointMotion joints() const = 0;
  virtual BaseMotion base() const = 0;
  virtual BodyMotion body(BodyIndex body) const = 0;

  /// Of a floor that gives way, at the current state; zero of another.
  virtual FloorLoad floorLoad(double spin_lever) const {
    (void)spin_lever;
    return {};
  }

  /// dy/dt at the current state.
  virtual void derivative(const MultibodyLoads& loads, double* ydot) = 0;
  /// dy/dt while a stand holds ball, base, wheels and arm still: only the rotors move.
  virtual void derivativeHeld(const MultibodyLoads& loads, double* ydot) = 0;
  /// Accelerations contained in a ydot that derivative() gave at the current state.
  virtual BaseAcceleration baseAcceleration(const double* ydot) const = 0;
  virtual JointAcceleration jointAcceleration(const double* ydot) const = 0;

  /// The wheels' contacts as derivative() found them last, where options asked for them.
  virtual WheelContacts wheelContacts() const { return {}; }

  /// The torque with which each wheel can turn against the ball until it slips on it, whatever its
  /// normal force; infinite at first. Only a structure whose wheels are bodies can slip.
  /// @throw InputError if a finite limit is asked of one that cannot.
  virtual void limitTraction(const Vector3& wheel_torque) = 0;

  /// Removes from y what integration let it drift off the constraints: quaternion length and, in
  /// the full structure, wheel rates that are not those of rolling.
  virtual void project(double* y) const = 0;

  /// Slip velocity of the three wheels on the ball at the current state, before projection [m/s].
  virtual Vector3 wheelSlip() const = 0;
  /// Kinetic and potential energy at the current state, zero potential at z = 0 [J].
  virtual double energy() const = 0;
};

/// @throw InputError if the parameters are not those of a physical robot.
std::unique_ptr<Multibody> makeMultibody(const RobotParameters& robot,
                                         const MultibodyOptions& options);

}  // namespace ballbot
