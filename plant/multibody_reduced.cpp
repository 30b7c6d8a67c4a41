#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "plant/multibody_structures.hpp"
#include "plant/robot_tree.hpp"
#include "plant/small_cholesky.hpp"

namespace ballbot {
namespace {

/// A body whose rotors' spin inertia about their axes is left to the gyrostat equations below.
BodyInertia withoutRotorSpin(BodyInertia body, BodyIndex index, const RobotParameters& robot,
                             const MultibodyOptions& options) {
  const auto mounts = actuatorMounts(robot);
  for (int i = 0; options.rotors && i < kJointCount; ++i) {
    const Vector3& a = mounts[i].axis;
    if (mounts[i].parent == index) {
      body.I_LLcm_L -= options.rotor_inertia[i] * a * a.transpose();
    }
  }
  return body;
}

/// Base and links, with the wheels on the base but for their spin.
std::array<BodyInertia, 1 + kArmJointCount> bodiesOf(const RobotParameters& robot,
                                                     const MultibodyOptions& options) {
  std::array<BodyInertia, 1 + kArmJointCount> bodies;
  bodies[0] = withoutRotorSpin(robot.baseWithWheels(), kBaseBody, robot, options);
  for (int i = 0; i + 1 < kArmJointCount; ++i) {
    bodies[1 + i] = withoutRotorSpin(robot.arm[i].inertia, armBody(i), robot, options);
  }
  bodies.back() = robot.lastLinkWithPayload();
  return bodies;
}

std::array<BodyInertia, kArmJointCount> linksOf(
    const std::array<BodyInertia, 1 + kArmJointCount>& bodies) {
  std::array<BodyInertia, kArmJointCount> links;
  std::copy(bodies.begin() + 1, bodies.end(), links.begin());
  return links;
}

/// Structure M: Simbody knows carriage, base and arm only. A wheel or rotor is axisymmetric, so
/// what it does besides its share in its carrier's inertia is known in closed form from its spin
/// about its axle, sigma = (own rate) + d . w_carrier:
///
///   wheel: kinetic energy 1/2 I_w sigma^2 with its rate tied to the platform by rolling,
///          so M += I_w a a^T, h += I_w a bias, and I_w sigma (w x d) on the base;
///   rotor: J dsigma/dt = its shaft torque, reaction and J sigma (w x d) on its carrier.
///
/// The mass matrix is the sum over the bodies of their kinetic energies: Simbody's calcM() takes
/// one pass per column and more time than everything else together.
///
/// y = (q, u of Simbody | wheel angles | rotor angles, rotor rates, both behind the gear).
class ReducedMultibody final : public Multibody {
 public:
  ReducedMultibody(const RobotParameters& robot, const MultibodyOptions& options)
      : options_(options),
        bodies_(bodiesOf(robot, options)),
        tree_(robot, bodies_[0], linksOf(bodies_), options.ball_spin),
        rolling_(robot),
        mounts_(actuatorMounts(robot)),
        wheel_inertia_(robot.wheels.spin_inertia),
        ball_inertia_(robot.ball.inertia),
        rolling_mass_(robot.ball.mass +
                      robot.ball.inertia / (robot.ball.radius * robot.ball.radius)) {
    for (int j = 0; j < kArmJointCount; ++j) lead_[j] = robot.arm[j].lead;
    tree_.finishTopology();
    nq_ = tree_.nq();
    nu_ = tree_.nu();
  }

  int stateDim() const override {
    return nq_ + nu_ + kWheelCount + (options_.rotors ? 2 * kJointCount : 0);
  }

  void place(const RobotPose& pose, double* y) const override {
    std::fill_n(y, stateDim(), 0.0);
    tree_.place(pose, y, y + nq_);
    if (options_.rotors) Eigen::Map<ArmVector>(y + rotorAngles() + kWheelCount) = pose.arm;
  }

  void setVelocity(const VelocityVector& nu, double ball_spin, double* y) const override {
    double* u = y + nq_;
    tree_.setVelocity(y, nu, ball_spin, u);
    if (!options_.rotors) return;
    Eigen::Map<Vector3>(y + rotorRates()) =
        rolling_.rates(tree_.rotationFromQ(y), {u[0], u[1], 0},
                       Eigen::Map<const Vector3>(u + kOmegaU), options_.ball_spin ? ball_spin : 0);
    Eigen::Map<ArmVector>(y + rotorRates() + kWheelCount) = nu.tail<kArmJointCount>();
  }

  void realize(const double* y) override {
    tree_.realize(y, y + nq_);
    const double* u = y + nq_;
    const BaseMotion& base = tree_.base();
    JointMotion& m = joints_;
    m.angle.head<kWheelCount>() = Eigen::Map<const Vector3>(y + wheelAngles());
    m.angle.tail<kArmJointCount>() = Eigen::Map<const ArmVector>(y + RobotTree::kArmQ);
    m.velocity.head<kWheelCount>() =
        rolling_.rates(base.R_WB, base.v_WK_W, base.w_WB_W, base.ball_spin);
    m.velocity.tail<kArmJointCount>() = Eigen::Map<const ArmVector>(u + kArmU);
    m.rotor_angle = m.angle;
    m.rotor_velocity = m.velocity;
    if (options_.rotors) {
      m.rotor_angle = Eigen::Map<const JointVector>(y + rotorAngles());
      m.rotor_velocity = Eigen::Map<const JointVector>(y + rotorRates());
    }
    for (int i = 0; i < kJointCount; ++i) {
      const BodyMotion& parent = tree_.body(mounts_[i].parent);
      axis_W_[i] = parent.R_WL * mounts_[i].axis;
      const double own = i < kWheelCount ? m.velocity[i] : 0;
      wheel_spin_[i] = own + axis_W_[i].dot(parent.w_WL_W);
      rotor_spin_[i] = options_.gear_ratio[i] * m.rotor_velocity[i] + axis_W_[i].dot(parent.w_WL_W);
    }
  }

  JointMotion joints() const override { return joints_; }
  BaseMotion base() const override { return tree_.base(); }
  BodyMotion body(BodyIndex index) const override { return tree_.body(index); }

  void derivative(const MultibodyLoads& loads, double* ydot) override {
    tree_.collectForces(loads);
    if (options_.rotors) applyRotorReactions(loads);
    // M udot + h - f at udot = 0, of the bodies that Simbody knows.
    tree_.matter.calcResidualForceIgnoringConstraints(tree_.state, tree_.mobilityForces(),
                                                      tree_.bodyForces(), no_udot_, residual_);
    SmallVector<kSharedDim> force{};
    const double* residual = &residual_[0];
    for (int k = 0; k < nu_; ++k) force[k] = -residual[k];
    assembleMass();
    applyWheels(loads, force);
    solveCholesky<kSharedDim>(mass_, force, nu_);
    const SmallVector<kSharedDim>& udot = force;

    const SimTK::Vector& qdot = tree_.state.getQDot();
    std::copy_n(&qdot[0], nq_, ydot);
    std::copy_n(udot.data(), nu_, ydot + nq_);
    Eigen::Map<Vector3>(ydot + wheelAngles()) = joints_.velocity.head<kWheelCount>();
    if (options_.rotors) rotorDerivative(loads, udot, ydot);
  }

  void derivativeHeld(const MultibodyLoads& loads, double* ydot) override {
    std::fill_n(ydot, stateDim(), 0.0);
    for (int i = 0; options_.rotors && i < kJointCount; ++i) {
      ydot[rotorAngles() + i] = joints_.rotor_velocity[i];
      ydot[rotorRates() + i] = loads.rotor_torque[i] / reflectedInertia(i);
    }
  }

  BaseAcceleration baseAcceleration(const double* ydot) const override {
    const double* udot = ydot + nq_;
    return {{udot[0], udot[1], 0}, Eigen::Map<const Vector3>(udot + kOmegaU)};
  }

  JointAcceleration jointAcceleration(const double* ydot) const override {
    const double* udot = ydot + nq_;
    JointAcceleration a;
    a.joint.head<kWheelCount>() = rolling_.rates(tree_.base().R_WB, {udot[0], udot[1], 0},
                                                 Eigen::Map<const Vector3>(udot + kOmegaU),
                                                 options_.ball_spin ? udot[kSpinU] : 0) +
                                  rolling_.bias(tree_.base());
    a.joint.tail<kArmJointCount>() = Eigen::Map<const ArmVector>(udot + kArmU);
    a.rotor = a.joint;
    if (options_.rotors) a.rotor = Eigen::Map<const JointVector>(ydot + rotorRates());
    return a;
  }

  void limitTraction(const Vector3& wheel_torque) override {
    if (std::isfinite(wheel_torque.minCoeff())) {
      throw InputError(
          "plant: wheels that are not bodies cannot slip; use plant.fidelity.multibody: full");
    }
  }
  void project(double* y) const override { tree_.normalizeQuaternion(y); }

  Vector3 wheelSlip() const override { return Vector3::Zero(); }

  double energy() const override {
    double energy = tree_.kineticEnergy() + tree_.potentialEnergy();
    for (int i = 0; i < kWheelCount; ++i) {
      energy += 0.5 * wheel_inertia_ * wheel_spin_[i] * wheel_spin_[i];
    }
    for (int i = 0; options_.rotors && i < kJointCount; ++i) {
      energy += 0.5 * options_.rotor_inertia[i] * rotor_spin_[i] * rotor_spin_[i];
    }
    return energy;
  }

 private:
  double reflectedInertia(int i) const {
    return options_.gear_ratio[i] * options_.gear_ratio[i] * options_.rotor_inertia[i];
  }

  /// On each rotor's carrier: the reaction to the shaft torque and to turning the rotor's spin.
  void applyRotorReactions(const MultibodyLoads& loads) {
    for (int i = 0; i < kJointCount; ++i) {
      const BodyIndex carrier = mounts_[i].parent;
      const double momentum = options_.rotor_inertia[i] * rotor_spin_[i];
      const Vector3 torque = -loads.rotor_torque[i] / options_.gear_ratio[i] * axis_W_[i] -
                             momentum * tree_.body(carrier).w_WL_W.cross(axis_W_[i]);
      tree_.addTorque(carrier, torque);
    }
  }

  /// M = sum over bodies of m Jv^T Jv + Jw^T I Jw, J of the centre of mass; lower triangle.
  void assembleMass() {
    for (auto& row : mass_) row.fill(0);
    mass_[0][0] = mass_[1][1] = rolling_mass_;
    mass_[kSpinU][kSpinU] = ball_inertia_;
    for (int b = 0; b <= kArmJointCount; ++b) {
      const BodyMotion& m = tree_.body(static_cast<BodyIndex>(kBaseBody + b));
      const Vector3 p = m.p_WL + m.R_WL * bodies_[b].p_LLcm_L;
      const Matrix3 I = m.R_WL * bodies_[b].I_LLcm_L * m.R_WL.transpose();
      const int columns = kArmU + b;  // joints further out do not move it
      std::array<Vector3, kArmU + kArmJointCount> Jv, Jw, IJw;
      for (int k = 0; k < 2; ++k) {
        Jv[k] = Vector3::Unit(k);
        Jw[k].setZero();
      }
      for (int k = 0; k < 3; ++k) {
        Jw[kOmegaU + k] = Vector3::Unit(k);
        Jv[kOmegaU + k] = Vector3::Unit(k).cross(p - tree_.base().p_WK);
      }
      for (int j = 0; j < b; ++j) {
        const Vector3& axis = axis_W_[kWheelCount + j];
        if (lead_[j] > 0) {
          Jw[kArmU + j].setZero();
          Jv[kArmU + j] = lead_[j] * axis;
          continue;
        }
        Jw[kArmU + j] = axis;
        Jv[kArmU + j] = axis.cross(p - tree_.body(static_cast<BodyIndex>(kLink1Body + j)).p_WL);
      }
      for (int k = 0; k < columns; ++k) IJw[k] = I * Jw[k];
      for (int i = 0; i < columns; ++i) {
        for (int j = 0; j <= i; ++j) {
          mass_[i][j] += bodies_[b].mass * Jv[i].dot(Jv[j]) + Jw[i].dot(IJw[j]);
        }
      }
    }
  }

  void applyWheels(const MultibodyLoads& loads, SmallVector<kSharedDim>& force) {
    const Vector3 bias = rolling_.bias(tree_.base());
    for (int i = 0; i < kWheelCount; ++i) {
      const Vector3& d = axis_W_[i];
      SharedRow row = rolling_.row(tree_.base().R_WB, i);
      for (int k = 0; k < nu_; ++k) force[k] += loads.joint_torque[i] * row[k];
      for (int k = 0; k < 3; ++k) row[kOmegaU + k] += d[k];  // now that of the wheel's spin in W
      for (int k = 0; k < nu_; ++k) force[k] -= wheel_inertia_ * bias[i] * row[k];
      const Vector3 gyroscopic = wheel_inertia_ * wheel_spin_[i] * tree_.base().w_WB_W.cross(d);
      for (int k = 0; k < 3; ++k) force[kOmegaU + k] -= gyroscopic[k];
      for (int k = 0; k < nu_; ++k) {
        for (int l = 0; l <= k; ++l) mass_[k][l] += wheel_inertia_ * row[k] * row[l];
      }
    }
  }

  /// J (N ddtheta + d . alpha_carrier) = shaft torque.
  void rotorDerivative(const MultibodyLoads& loads, const SmallVector<kSharedDim>& udot,
                       double* ydot) const {
    Vector3 alpha(udot[kOmegaU], udot[kOmegaU + 1], udot[kOmegaU + 2]);  // of carrier after carrier
    for (int i = 0; i < kJointCount; ++i) {
      ydot[rotorAngles() + i] = joints_.rotor_velocity[i];
      ydot[rotorRates() + i] = loads.rotor_torque[i] / reflectedInertia(i) -
                               axis_W_[i].dot(alpha) / options_.gear_ratio[i];
      if (i < kWheelCount || lead_[i - kWheelCount] > 0) continue;
      alpha += udot[kArmU + i - kWheelCount] * axis_W_[i] +
               joints_.velocity[i] * tree_.body(mounts_[i].parent).w_WL_W.cross(axis_W_[i]);
    }
  }

  int wheelAngles() const { return nq_ + nu_; }
  int rotorAngles() const { return nq_ + nu_ + kWheelCount; }
  int rotorRates() const { return rotorAngles() + kJointCount; }

  MultibodyOptions options_;
  std::array<BodyInertia, 1 + kArmJointCount> bodies_;
  RobotTree tree_;
  WheelRolling rolling_;
  std::array<double, kArmJointCount> lead_;  ///< of arm joints that slide; else 0 [m/rad]
  std::array<ActuatorMount, kJointCount> mounts_;
  double wheel_inertia_, ball_inertia_, rolling_mass_;
  int nq_ = 0, nu_ = 0;

  // Of the current state:
  JointMotion joints_;
  std::array<Vector3, kJointCount> axis_W_;
  JointVector wheel_spin_, rotor_spin_;  ///< about the axle, in W [rad/s]

  SmallMatrix<kSharedDim> mass_;
  SimTK::Vector residual_;
  const SimTK::Vector no_udot_;
};

}  // namespace

std::unique_ptr<Multibody> makeReducedMultibody(const RobotParameters& robot,
                                                const MultibodyOptions& options) {
  return std::make_unique<ReducedMultibody>(robot, options);
}

}  // namespace ballbot
