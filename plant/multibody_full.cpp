#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "plant/multibody_structures.hpp"
#include "plant/robot_tree.hpp"
#include "plant/small_cholesky.hpp"

namespace ballbot {
namespace {

/// A rotor's mass and transverse inertia are part of the body that carries it and are taken out
/// there again, so these two figures only have to be those of some rigid body.
BodyInertia rotorInertia(double axial, const Vector3& axis) {
  BodyInertia rotor;
  rotor.mass = 0.05;
  rotor.I_LLcm_L = axial * (0.6 * Matrix3::Identity() + 0.4 * axis * axis.transpose());
  return rotor;
}

/// Mass properties of a body's carried rotors removed: locked, they leave the robot as it was.
BodyInertia withoutRotors(BodyInertia body, BodyIndex index, const RobotParameters& robot,
                          const MultibodyOptions& options) {
  const auto mounts = actuatorMounts(robot);
  for (int i = 0; options.rotors && i < kJointCount; ++i) {
    if (mounts[i].parent != index) continue;
    body = without(body, rotorInertia(options.rotor_inertia[i], mounts[i].axis), mounts[i].p_PA_P);
  }
  return body;
}

std::array<BodyInertia, kArmJointCount> linksOf(const RobotParameters& robot,
                                                const MultibodyOptions& options) {
  std::array<BodyInertia, kArmJointCount> links;
  for (int i = 0; i + 1 < kArmJointCount; ++i) {
    links[i] = withoutRotors(robot.arm[i].inertia, armBody(i), robot, options);
  }
  links.back() = robot.lastLinkWithPayload();
  return links;
}

/// Structure R. y = (q, u) of Simbody.
class FullMultibody final : public Multibody {
 public:
  FullMultibody(const RobotParameters& robot, const MultibodyOptions& options)
      : robot_(robot),
        options_(options),
        tree_(robot, withoutRotors(robot.base, kBaseBody, robot, options), linksOf(robot, options),
              options.ball_spin),
        rolling_(robot) {
    addWheels();
    if (options.rotors) addRotors();
    tree_.finishTopology();
    nq_ = tree_.nq();
    nu_ = tree_.nu();
    constraint_force_.resize(nu_);
    constraint_force_ = 0;
    for (SimTK::Vector& column : response_) column.resize(nu_);
    wheel_q_ = tree_.sharedQ();
    wheel_u_ = tree_.sharedU();
    Matrix3 normals;
    for (int i = 0; i < kWheelCount; ++i) {
      normals.col(i) = robot.wheelCentre(i).normalized();
      tangents_.col(i) = normals.col(i).cross(robot.wheelAxle(i));
    }
    along_normals_ = normals.inverse();
    traction_.fade_s = options.slip_fade_s;
    if (options.wheel_slip) {
      const double r_w = robot.wheels.radius;
      traction_.friction_lever = options.wheel_slip->friction * r_w;
      traction_.creep = options.wheel_slip->creep / (r_w * r_w);
    }
  }

  int stateDim() const override { return nq_ + nu_; }

  void place(const RobotPose& pose, double* y) const override {
    tree_.place(pose, y, y + nq_);
    if (!options_.rotors) return;
    for (int j = 0; j < kArmJointCount; ++j) {
      y[rotorQ(kWheelCount + j)] = options_.gear_ratio[kWheelCount + j] * pose.arm[j];
    }
  }

  void setVelocity(const VelocityVector& nu, double ball_spin, double* y) const override {
    double* u = y + nq_;
    tree_.setVelocity(y, nu, ball_spin, u);
    project(y);
    if (!options_.rotors) return;
    for (int i = 0; i < kJointCount; ++i) u[rotorU(i)] = options_.gear_ratio[i] * u[jointU(i)];
  }

  void realize(const double* y) override { tree_.realize(y, y + nq_); }

  JointMotion joints() const override {
    const double* q = &tree_.state.getQ()[0];
    const double* u = &tree_.state.getU()[0];
    JointMotion m;
    for (int i = 0; i < kJointCount; ++i) {
      m.angle[i] = q[jointQ(i)];
      m.velocity[i] = u[jointU(i)];
      m.rotor_angle[i] = options_.rotors ? q[rotorQ(i)] / options_.gear_ratio[i] : m.angle[i];
      m.rotor_velocity[i] = options_.rotors ? u[rotorU(i)] / options_.gear_ratio[i] : m.velocity[i];
    }
    return m;
  }

  BaseMotion base() const override { return tree_.base(); }
  BodyMotion body(BodyIndex index) const override { return tree_.body(index); }

  void derivative(const MultibodyLoads& loads, double* ydot) override {
    tree_.collectForces(loads);
    double* f = &tree_.mobilityForces()[0];
    for (int i = 0; i < kWheelCount; ++i) f[wheel_u_ + i] = loads.joint_torque[i];
    for (int i = 0; options_.rotors && i < kJointCount; ++i) {
      f[rotorU(i)] = loads.rotor_torque[i] / options_.gear_ratio[i];
    }
    tree_.system.realize(tree_.state, SimTK::Stage::Dynamics);
    tree_.matter.calcAccelerationIgnoringConstraints(tree_.state, tree_.mobilityForces(),
                                                     tree_.bodyForces(), udot_, body_acceleration_);
    if (contactsMatter()) {
      carried_ = tree_.carriedLoad(loads, body_acceleration_);
    }
    addRollingConstraint();
    const SimTK::Vector& qdot = tree_.state.getQDot();
    std::copy_n(&qdot[0], nq_, ydot);
    std::copy_n(&udot_[0], nu_, ydot + nq_);
  }

  void derivativeHeld(const MultibodyLoads& loads, double* ydot) override {
    std::fill_n(ydot, stateDim(), 0.0);
    for (int i = 0; options_.rotors && i < kJointCount; ++i) {
      ydot[rotorQ(i)] = tree_.state.getU()[rotorU(i)];
      ydot[nq_ + rotorU(i)] =
          loads.rotor_torque[i] / (options_.gear_ratio[i] * options_.rotor_inertia[i]);
    }
  }

  BaseAcceleration baseAcceleration(const double* ydot) const override {
    const double* udot = ydot + nq_;
    return {{udot[0], udot[1], 0}, Eigen::Map<const Vector3>(udot + kOmegaU)};
  }

  JointAcceleration jointAcceleration(const double* ydot) const override {
    const double* udot = ydot + nq_;
    JointAcceleration a;
    for (int i = 0; i < kJointCount; ++i) {
      a.joint[i] = udot[jointU(i)];
      a.rotor[i] = options_.rotors ? udot[rotorU(i)] / options_.gear_ratio[i] : a.joint[i];
    }
    return a;
  }

  void project(double* y) const override {
    tree_.normalizeQuaternion(y);
    double* u = y + nq_;
    const Vector3 rates =
        rolling_.rates(tree_.rotationFromQ(y), {u[0], u[1], 0},
                       Eigen::Map<const Vector3>(u + kOmegaU), options_.ball_spin ? u[kSpinU] : 0);
    for (int i = 0; i < kWheelCount; ++i) {
      if (rolls(i)) u[wheel_u_ + i] = rates[i];
    }
  }

  void limitTraction(const Vector3& wheel_torque) override { traction_.limit = wheel_torque; }

  WheelContacts wheelContacts() const override { return contacts_; }

  Vector3 wheelSlip() const override {
    const BaseMotion& m = tree_.base();
    const Vector3 rates = Eigen::Map<const Vector3>(&tree_.state.getU()[wheel_u_]);
    return robot_.wheels.radius * (rates - rolling_.rates(m.R_WB, m.v_WK_W, m.w_WB_W, m.ball_spin));
  }

  double energy() const override { return tree_.kineticEnergy() + tree_.potentialEnergy(); }

 private:
  int jointQ(int i) const {
    return i < kWheelCount ? wheel_q_ + i : RobotTree::kArmQ + i - kWheelCount;
  }
  int jointU(int i) const { return i < kWheelCount ? wheel_u_ + i : kArmU + i - kWheelCount; }
  int rotorQ(int i) const { return wheel_q_ + kWheelCount + i; }
  int rotorU(int i) const { return wheel_u_ + kWheelCount + i; }

  void addWheels() {
    SimTK::MobilizedBody base = tree_.mobilizedBody(kBaseBody);
    for (int i = 0; i < kWheelCount; ++i) {
      const Vector3 d = robot_.wheelAxle(i);
      BodyInertia wheel;
      wheel.mass = robot_.wheels.mass;
      wheel.I_LLcm_L =
          robot_.wheels.transverse_inertia * (Matrix3::Identity() - d * d.transpose()) +
          robot_.wheels.spin_inertia * d * d.transpose();
      SimTK::MobilizedBody::Pin(base, pinFrame(d, robot_.wheelCentre(i)), toBody(wheel, "a wheel"),
                                pinFrame(d, Vector3::Zero()));
    }
  }

  /// A pin whose coordinate is the rotor's own angle, gear ratio times the angle behind the gear.
  void addRotors() {
    const auto mounts = actuatorMounts(robot_);
    for (int i = 0; i < kJointCount; ++i) {
      SimTK::MobilizedBody parent = tree_.mobilizedBody(mounts[i].parent);
      const Vector3 axis = mounts[i].axis;
      SimTK::MobilizedBody::Pin(parent, pinFrame(axis, mounts[i].p_PA_P),
                                toBody(rotorInertia(options_.rotor_inertia[i], axis), "a rotor"),
                                pinFrame(axis, Vector3::Zero()));
    }
  }

  /// Three rows G udot = bias, wheel rates equal to those of rolling; the multipliers follow from
  /// G M^-1 G^T. One articulated-body pass per row; Simbody's general constraint solver takes
  /// twice the time of the whole tree for the same three rows.
  void addRollingConstraint() {
    const int n = tree_.sharedU();
    std::array<SharedRow, kWheelCount> rows;
    for (int i = 0; i < kWheelCount; ++i) rows[i] = rolling_.row(tree_.base().R_WB, i);
    const auto rowTimes = [&](int i, const double* v) {
      double sum = v[wheel_u_ + i];
      for (int k = 0; k < n; ++k) sum -= rows[i][k] * v[k];
      return sum;
    };
    double* force = &constraint_force_[0];
    double* udot = &udot_[0];
    std::array<const double*, kWheelCount> response;  // M^-1 G^T, by column
    SmallMatrix<kWheelCount> A;                       // G M^-1 G^T
    for (int i = 0; i < kWheelCount; ++i) {
      for (int k = 0; k < n; ++k) force[k] = -rows[i][k];
      force[wheel_u_ + i] = 1;
      tree_.matter.multiplyByMInv(tree_.state, constraint_force_, response_[i]);
      force[wheel_u_ + i] = 0;
      response[i] = &response_[i][0];
      for (int j = i; j < kWheelCount; ++j) A[j][i] = rowTimes(j, response[i]);
    }
    const Vector3 bias = rolling_.bias(tree_.base());
    SmallVector<kWheelCount> multipliers;
    for (int i = 0; i < kWheelCount; ++i) multipliers[i] = bias[i] - rowTimes(i, udot);
    const bool all_roll = rolls(0) && rolls(1) && rolls(2);
    if (!all_roll || contactsMatter()) {
      const double* u = &tree_.state.getU()[0];
      for (int i = 0; i < kWheelCount; ++i) {
        for (int j = 0; j <= i; ++j) traction_.A(i, j) = traction_.A(j, i) = A[i][j];
        traction_.wanted[i] = multipliers[i];
        traction_.slip[i] = rowTimes(i, u);
      }
      if (contactsMatter()) findNormalForces(response);
    }
    if (all_roll) {
      solveCholesky<kWheelCount>(A, multipliers, kWheelCount);
    } else {
      Eigen::Map<Vector3>(multipliers.data()) = solveTraction(traction_);
    }
    if (contactsMatter()) {
      const Vector3 torque = Eigen::Map<const Vector3>(multipliers.data());
      contacts_ = {traction_.normalForce(torque), torque / robot_.wheels.radius,
                   traction_.slip * robot_.wheels.radius};
    }
    for (int k = 0; k < nu_; ++k) {
      udot[k] += response[0][k] * multipliers[0] + response[1][k] * multipliers[1] +
                 response[2][k] * multipliers[2];
    }
  }

  bool rolls(int wheel) const { return !traction_.canSlip(wheel); }

  bool contactsMatter() const { return options_.wheel_contacts || options_.wheel_slip; }

  /// What the ball carries is borne by its wheels alone: along normals c_i and driven tangents
  /// t_i = c_i x d_i, across which the rollers roll freely.
  ///
  ///   sum of N_i c_i + lambda_i / r_w t_i = load at lambda = 0 + (its change) lambda
  ///
  /// @param response  velocities' change per torque of each contact
  void findNormalForces(const std::array<const double*, kWheelCount>& response) {
    Matrix3 change;
    for (int i = 0; i < kWheelCount; ++i) change.col(i) = tree_.carriedMomentum(response[i]);
    const Matrix3 R_BW = tree_.base().R_WB.transpose();
    traction_.N_free = along_normals_ * (R_BW * carried_);
    traction_.N_torque = along_normals_ * (R_BW * change - tangents_ / robot_.wheels.radius);
  }

  RobotParameters robot_;
  MultibodyOptions options_;
  RobotTree tree_;
  WheelRolling rolling_;
  int nq_ = 0, nu_ = 0, wheel_q_ = 0, wheel_u_ = 0;
  Matrix3 tangents_;       ///< columns t_i in B
  Matrix3 along_normals_;  ///< components of a force in B along the three c_i
  TractionProblem traction_;
  WheelContacts contacts_;
  Vector3 carried_ = Vector3::Zero();  ///< by the ball, were the wheels free of it [N]
  SimTK::Vector udot_, constraint_force_;
  std::array<SimTK::Vector, kWheelCount> response_;
  SimTK::Vector_<SimTK::SpatialVec> body_acceleration_;
};

}  // namespace

std::unique_ptr<Multibody> makeFullMultibody(const RobotParameters& robot,
                                             const MultibodyOptions& options) {
  return std::make_unique<FullMultibody>(robot, options);
}

}  // namespace ballbot
