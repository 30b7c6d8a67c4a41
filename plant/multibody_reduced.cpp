#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "model/frames.hpp"
#include "plant/multibody_structures.hpp"
#include "plant/robot_tree.hpp"

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
  return {withoutRotorSpin(robot.baseWithWheels(), kBaseBody, robot, options),
          withoutRotorSpin(robot.arm[0].inertia, kLink1Body, robot, options),
          withoutRotorSpin(robot.arm[1].inertia, kLink2Body, robot, options),
          robot.lastLinkWithPayload()};
}

/// Structure M: Simbody knows carriage, base and arm only. A wheel or rotor is axisymmetric, so
/// what it does besides its share in its carrier's inertia is known in closed form from its spin
/// about its axle, sigma = (own rate) + d . w_carrier:
///
///   wheel: kinetic energy 1/2 I_w sigma^2 with its rate tied to the platform by rolling,
///          so M += I_w a a^T, h += I_w a bias, and I_w sigma (w x d) on the base;
///   rotor: J dsigma/dt = its shaft torque, reaction and J sigma (w x d) on its carrier.
///
/// The mass matrix is the sum over four bodies of their kinetic energies: Simbody's calcM() takes
/// one pass per column and more time than everything else together.
///
/// y = (q, u of Simbody | wheel angles | rotor angles, rotor rates, both behind the gear).
template <bool kBallSpin>
class ReducedMultibody final : public Multibody {
 public:
  ReducedMultibody(const RobotParameters& robot, const MultibodyOptions& options)
      : options_(options),
        bodies_(bodiesOf(robot, options)),
        tree_(robot, bodies_[0], {bodies_[1], bodies_[2], bodies_[3]}, options.ball_spin),
        rolling_(robot, options.ball_spin),
        mounts_(actuatorMounts(robot)),
        wheel_inertia_(robot.wheels.spin_inertia),
        ball_inertia_(robot.ball.inertia),
        rolling_mass_(robot.ball.mass +
                      robot.ball.inertia / (robot.ball.radius * robot.ball.radius)) {
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
    if (options_.rotors) Eigen::Map<Vector3>(y + rotorAngles() + kWheelCount) = pose.arm;
  }

  void setVelocity(const VelocityVector& nu, double ball_spin, double* y) const override {
    double* u = y + nq_;
    tree_.setVelocity(y, nu, ball_spin, u);
    if (!options_.rotors) return;
    Eigen::Map<Vector3>(y + rotorRates()) = rolling_.rates(tree_.rotationFromQ(y), u);
    Eigen::Map<Vector3>(y + rotorRates() + kWheelCount) = nu.segment<3>(kArmRate1);
  }

  void realize(const double* y) override {
    tree_.realize(y, y + nq_);
    const double* u = y + nq_;
    rows_ = rolling_.rows(tree_.base().R_WB);
    JointMotion& m = joints_;
    m.angle.head<kWheelCount>() = Eigen::Map<const Vector3>(y + wheelAngles());
    m.angle.tail<kArmJointCount>() = Eigen::Map<const Vector3>(y + tree_.armQOffset());
    m.velocity.head<kWheelCount>() =
        rows_ * Eigen::Map<const Eigen::Matrix<double, kPlatform, 1>>(u);
    m.velocity.tail<kArmJointCount>() = Eigen::Map<const Vector3>(u + tree_.armUOffset());
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
    Vector force = -Eigen::Map<const Vector>(&residual_[0]);
    assembleMass();
    applyWheels(loads, force);
    mass_.llt().solveInPlace(force);
    const Vector& udot = force;

    const SimTK::Vector& qdot = tree_.state.getQDot();
    std::copy_n(&qdot[0], nq_, ydot);
    Eigen::Map<Vector>(ydot + nq_) = udot;
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
    return {{udot[0], udot[1], 0}, Eigen::Map<const Vector3>(udot + tree_.omegaOffset())};
  }

  JointAcceleration jointAcceleration(const double* ydot) const override {
    const double* udot = ydot + nq_;
    JointAcceleration a;
    a.joint.head<kWheelCount>() =
        rolling_.rates(tree_.base().R_WB, udot) + rolling_.bias(tree_.base());
    a.joint.tail<kArmJointCount>() = Eigen::Map<const Vector3>(udot + tree_.armUOffset());
    a.rotor = a.joint;
    if (options_.rotors) a.rotor = Eigen::Map<const JointVector>(ydot + rotorRates());
    return a;
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
  /// Of u = (vx, vy, [spin], w_WB_W | arm rates): the part that turns wheels, and all of it.
  static constexpr int kOmega = kBallSpin ? 3 : 2;
  static constexpr int kPlatform = kOmega + 3;
  static constexpr int kDim = kPlatform + kArmJointCount;
  using Vector = Eigen::Matrix<double, kDim, 1>;
  using BodyJacobian = Eigen::Matrix<double, 3, kDim>;

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
      const auto index = tree_.mobilizedBody(carrier).getMobilizedBodyIndex();
      tree_.bodyForces()[index][0] += toSimTK(torque);
    }
  }

  /// M = sum over bodies of m Jv^T Jv + Jw^T I Jw, J of the centre of mass.
  void assembleMass() {
    mass_.setZero();
    mass_(0, 0) = mass_(1, 1) = rolling_mass_;
    if (kBallSpin) mass_(2, 2) = ball_inertia_;
    BodyJacobian Jw = BodyJacobian::Zero(), Jv = BodyJacobian::Zero();
    Jw.template middleCols<3>(kOmega).setIdentity();
    Jv(0, 0) = Jv(1, 1) = 1;
    for (int b = 0; b <= kArmJointCount; ++b) {
      const BodyMotion& m = tree_.body(static_cast<BodyIndex>(kBaseBody + b));
      if (b > 0) Jw.col(kPlatform + b - 1) = axis_W_[kWheelCount + b - 1];
      const Vector3 p = m.p_WL + m.R_WL * bodies_[b].p_LLcm_L;
      Jv.template middleCols<3>(kOmega) = -skew(p - tree_.base().p_WK);
      for (int j = 1; j <= b; ++j) {
        const Vector3& origin = tree_.body(static_cast<BodyIndex>(kBaseBody + j)).p_WL;
        Jv.col(kPlatform + j - 1) = axis_W_[kWheelCount + j - 1].cross(p - origin);
      }
      const Matrix3 I = m.R_WL * bodies_[b].I_LLcm_L * m.R_WL.transpose();
      const BodyJacobian IJw = I * Jw;
      mass_.noalias() += bodies_[b].mass * Jv.transpose().lazyProduct(Jv);
      mass_.noalias() += Jw.transpose().lazyProduct(IJw);
    }
  }

  void applyWheels(const MultibodyLoads& loads, Vector& force) {
    const Vector3 bias = rolling_.bias(tree_.base());
    for (int i = 0; i < kWheelCount; ++i) {
      const Vector3& d = axis_W_[i];
      Eigen::Matrix<double, kPlatform, 1> row = rows_.row(i).transpose();
      force.template head<kPlatform>() += loads.joint_torque[i] * row;
      row.template tail<3>() += d;  // now the row of the wheel's spin in W
      force.template head<kPlatform>() -= wheel_inertia_ * bias[i] * row;
      force.template segment<3>(kOmega) -=
          wheel_inertia_ * wheel_spin_[i] * tree_.base().w_WB_W.cross(d);
      mass_.template topLeftCorner<kPlatform, kPlatform>() +=
          wheel_inertia_ * row * row.transpose();
    }
  }

  /// J (N ddtheta + d . alpha_carrier) = shaft torque.
  void rotorDerivative(const MultibodyLoads& loads, const Vector& udot, double* ydot) const {
    Vector3 alpha = udot.template segment<3>(kOmega);  // of the carrier, link by link
    for (int i = 0; i < kJointCount; ++i) {
      ydot[rotorAngles() + i] = joints_.rotor_velocity[i];
      ydot[rotorRates() + i] = loads.rotor_torque[i] / reflectedInertia(i) -
                               axis_W_[i].dot(alpha) / options_.gear_ratio[i];
      if (i < kWheelCount) continue;
      alpha += udot[kPlatform + i - kWheelCount] * axis_W_[i] +
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
  std::array<ActuatorMount, kJointCount> mounts_;
  double wheel_inertia_, ball_inertia_, rolling_mass_;
  int nq_ = 0, nu_ = 0;

  // Of the current state:
  JointMotion joints_;
  Eigen::Matrix<double, kWheelCount, kPlatform> rows_;
  std::array<Vector3, kJointCount> axis_W_;
  JointVector wheel_spin_, rotor_spin_;  ///< about the axle, in W [rad/s]

  Eigen::Matrix<double, kDim, kDim> mass_;
  SimTK::Vector residual_;
  const SimTK::Vector no_udot_;
};

}  // namespace

std::unique_ptr<Multibody> makeReducedMultibody(const RobotParameters& robot,
                                                const MultibodyOptions& options) {
  if (options.ball_spin) return std::make_unique<ReducedMultibody<true>>(robot, options);
  return std::make_unique<ReducedMultibody<false>>(robot, options);
}

}  // namespace ballbot
