#pragma once

#include "controller/arm_inverse_kinematics.hpp"
#include "controller/mpc_law.hpp"

namespace ballbot {

class ConfigReader;

struct ArmPidConfig {
  double stiffness = 80;       ///< [N m/rad]
  double damping = 6;          ///< [N m s/rad]
  double integral = 80;        ///< [N m/(rad s)]
  double integral_limit = 10;  ///< of the integral's torque [N m]

  void describe(ConfigVisitor& v);
};

struct DecoupledConfig {
  ArmInverseKinematicsConfig inverse_kinematics;
  ArmPidConfig pid;

  void describe(ConfigVisitor& v);
  static DecoupledConfig read(ConfigReader& in);
};

/// The baseline the whole-body MPC is measured against (Minniti et al. 2019, third experiment): an
/// MPC that balances a base whose arm it takes to be rigid at its nominal pose, and beside it an
/// arm that follows the end-effector's reference by inverse kinematics and joint PID with gravity
/// compensation. Both are told of a payload, but the base not where the arm takes it; the arm may
/// reach from where the base is, but has no say in where it goes.
///
/// The tasks are those of the whole-body MPC: the base takes the ball's, the yaw's and the wheels',
/// the arm takes the end-effector's. The PID stands in the plan's feedback, beside the tracker's
/// own joint PD.
class DecoupledLaw final : public ControlLaw {
 public:
  /// @param mpc  as for the whole-body law
  /// @throw NumericalError as MpcLaw.
  DecoupledLaw(const RobotParameters& robot, const MpcConfig& mpc, const DecoupledConfig& config);

  PlanReport plan(SimTime now, const StateVector& x,
                  const JointVector& joint_angle) noexcept override;
  void setCircumstances(const Circumstances& now) noexcept override;
  void activatePlan() noexcept override;
  void sample(SimTime now, PolicySample& out) const noexcept override;
  void commanded(SimTime now, SimDuration period, const JointVector& torque) noexcept override;

  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;

 private:
  /// What the arm is asked to do from `stamp` on: a set-point that moves at a constant rate.
  struct ArmPlan {
    bool valid = false;
    SimTime stamp{};
    ArmVector position = ArmVector::Zero(), rate = ArmVector::Zero();
    ArmVector gravity = ArmVector::Zero();   ///< torque that holds the arm at rest there [N m]
    ArmVector integral = ArmVector::Zero();  ///< torque of the integral [N m]

    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.valid);
      visit(self.stamp);
      visit(self.position);
      visit(self.rate);
      visit(self.gravity);
      visit(self.integral);
    }
  };
  /// What is saved.
  struct State;
  void planArm(SimTime now, const StateVector& x) noexcept;
  /// Torque at the arm's joints that holds the robot still at x [N m].
  ArmVector gravityTorque(const StateVector& x) const noexcept;

  ArmInverseKinematicsConfig::Base ik_base_;
  ReducedDynamics dynamics_;
  /// Of the robot with its arm in the nominal pose, which is all the base knows.
  StateVector rest_;
  std::shared_ptr<const TaskSchedule> schedule_;
  double known_payload_;                               ///< [kg]
  Eigen::Matrix<double, 3, kVelocityDim> hand_by_nu_;  ///< v_WE_W by nu, at rest_
  ArmInverseKinematics inverse_kinematics_;
  ArmPidConfig pid_;
  MpcLaw base_;
  ArmPlan planned_, active_;
};

}  // namespace ballbot
