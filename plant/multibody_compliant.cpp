#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "model/frames.hpp"
#include "plant/multibody_structures.hpp"
#include "plant/small_cholesky.hpp"
#include "plant/turning_bodies.hpp"

namespace ballbot {
namespace {

using SimTK::MobilizedBody;
using SimTK::SpatialVec;
using SimTK::Vec3;

/// A ball that moves and turns freely on a floor that it can sink into, slip on and leave; the base
/// turns about the ball's centre, and the wheels roll on the ball without slip:
///
///   dphi_i = -(r/r_w) d_i . (kappa - w),   kappa the ball's, w the base's angular velocity.
///
/// y = (q, u) of Simbody, in the order of their making: place of the ball's centre, attitude of the
/// base, arm, wheels, rotors, attitude of the ball. Angular velocities are in W.
class CompliantMultibody final : public Multibody {
 public:
  CompliantMultibody(const RobotParameters& robot, const MultibodyOptions& options)
      : robot_(robot),
        options_(options),
        floor_(*options.floor, robot.ball.radius, options.spin_smoothing),
        ratio_(robot.ball.radius / robot.wheels.radius),
        matter_(system_) {
    addBodies();
    state_ = system_.realizeTopology();
    system_.realizeModel(state_);
    system_.realize(state_, SimTK::Stage::Instance);
    nq_ = state_.getNQ();
    nu_ = state_.getNU();
    for (MobilizedBody& body : bodies_) {
      mass_ += body.getBodyMass(state_);
      gravity_points_.push_back(&body);
    }
    for (MobilizedBody& body : turning_) {
      mass_ += body.getBodyMass(state_);
      gravity_points_.push_back(&body);
    }
    ball_u_ = bodies_[kBallBody].getFirstUIndex(state_);
    ball_q_ = bodies_[kBallBody].getFirstQIndex(state_);
    row_.resize(nu_);
    for (SimTK::Vector& column : response_) column.resize(nu_);
  }

  int stateDim() const override { return nq_ + nu_; }

  /// The ball as deep in the floor as the robot's weight presses it.
  void place(const RobotPose& pose, double* y) const override {
    std::fill_n(y, stateDim(), 0.0);
    y[0] = pose.px;
    y[1] = pose.py;
    y[2] = robot_.ball.radius - floor_.restingDepth(mass_ * robot_.gravity);
    const Eigen::Quaterniond quat(rotationFromYawPitchRoll(pose.yaw, pose.pitch, pose.roll));
    const double wxyz[] = {quat.w(), quat.x(), quat.y(), quat.z()};
    std::copy_n(wxyz, 4, y + kBaseQ);
    std::copy_n(pose.arm.data(), kArmJointCount, y + kArmQ);
    y[ball_q_] = 1;
    for (int j = kWheelCount; options_.rotors && j < kJointCount; ++j) {
      y[rotorQ(j)] = options_.gear_ratio[j] * pose.arm[j - kWheelCount];
    }
  }

  /// The ball rolls and spins; its centre stays at its height.
  void setVelocity(const VelocityVector& nu, double ball_spin, double* y) const override {
    double* u = y + nq_;
    std::fill_n(u, nu_, 0.0);
    u[0] = nu[kBallVx];
    u[1] = nu[kBallVy];
    Eigen::Map<Vector3>(u + kBaseU) = rotationFromQ(y) * nu.segment<3>(kOmegaX);
    Eigen::Map<ArmVector>(u + kArmU) = nu.tail<kArmJointCount>();
    Eigen::Map<Vector3>(u + ball_u_) << -u[1] / robot_.ball.radius, u[0] / robot_.ball.radius,
        ball_spin;
    project(y);
    for (int i = 0; options_.rotors && i < kJointCount; ++i) {
      u[rotorU(i)] = options_.gear_ratio[i] * u[jointU(i)];
    }
  }

  void realize(const double* y) override {
    std::copy_n(y, nq_, &state_.updQ()[0]);
    std::copy_n(y + nq_, nu_, &state_.updU()[0]);
    system_.realize(state_, SimTK::Stage::Velocity);
  }

  JointMotion joints() const override {
    const double* q = &state_.getQ()[0];
    const double* u = &state_.getU()[0];
    JointMotion m;
    for (int i = 0; i < kJointCount; ++i) {
      m.angle[i] = q[jointQ(i)];
      m.velocity[i] = u[jointU(i)];
      m.rotor_angle[i] = options_.rotors ? q[rotorQ(i)] / options_.gear_ratio[i] : m.angle[i];
      m.rotor_velocity[i] = options_.rotors ? u[rotorU(i)] / options_.gear_ratio[i] : m.velocity[i];
    }
    return m;
  }

  BaseMotion base() const override {
    const BodyMotion m = body(kBaseBody);
    return {m.p_WL, m.R_WL, m.v_WL_W, m.w_WL_W, state_.getU()[ball_u_ + 2]};
  }

  BodyMotion body(BodyIndex index) const override {
    const SimTK::Transform& X = bodies_[index].getBodyTransform(state_);
    const SpatialVec& V = bodies_[index].getBodyVelocity(state_);
    const bool ball = index == kBallBody;  // its axes are those of W, whatever its attitude
    return {toEigen(X.p()), ball ? Matrix3::Identity() : toEigen(X.R()), toEigen(V[1]),
            toEigen(V[0])};
  }

  FloorLoad floorLoad(double spin_lever) const override {
    const BodyMotion ball = body(kBallBody);
    return floor_.load(ball.p_WL.z(), ball.v_WL_W, ball.w_WL_W, spin_lever);
  }

  void derivative(const MultibodyLoads& loads, double* ydot) override {
    collectForces(loads);
    system_.realize(state_, SimTK::Stage::Dynamics);
    matter_.calcAccelerationIgnoringConstraints(state_, mobility_forces_, body_forces_, udot_,
                                                body_acceleration_);
    rollWheelsOnBall();
    std::copy_n(&state_.getQDot()[0], nq_, ydot);
    std::copy_n(&udot_[0], nu_, ydot + nq_);
  }

  void derivativeHeld(const MultibodyLoads& loads, double* ydot) override {
    std::fill_n(ydot, stateDim(), 0.0);
    for (int i = 0; options_.rotors && i < kJointCount; ++i) {
      ydot[rotorQ(i)] = state_.getU()[rotorU(i)];
      ydot[nq_ + rotorU(i)] =
          loads.rotor_torque[i] / (options_.gear_ratio[i] * options_.rotor_inertia[i]);
    }
  }

  BaseAcceleration baseAcceleration(const double* ydot) const override {
    const double* udot = ydot + nq_;
    return {Eigen::Map<const Vector3>(udot), Eigen::Map<const Vector3>(udot + kBaseU)};
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

  void limitTraction(const Vector3& wheel_torque) override {
    if (std::isfinite(wheel_torque.minCoeff())) {
      throw InputError(
          "plant: wheels cannot slip on the ball with plant.fidelity.contact: compliant");
    }
  }

  void project(double* y) const override {
    for (const int first : {kBaseQ, ball_q_}) {
      Eigen::Map<Eigen::Vector4d> quat(y + first);
      quat /= quat.norm();
    }
    double* u = y + nq_;
    Eigen::Map<Vector3>(u + kWheelU) = rollingRates(rotationFromQ(y), u);
  }

  Vector3 wheelSlip() const override {
    const double* u = &state_.getU()[0];
    return robot_.wheels.radius *
           (Eigen::Map<const Vector3>(u + kWheelU) - rollingRates(body(kBaseBody).R_WL, u));
  }

  double energy() const override {
    double energy = matter_.calcKineticEnergy(state_) + floor_.energy(state_.getQ()[2]);
    for (const MobilizedBody* body : gravity_points_) {
      const Vec3 p =
          body->findStationLocationInGround(state_, body->getBodyMassCenterStation(state_));
      energy += robot_.gravity * body->getBodyMass(state_) * p[2];
    }
    return energy;
  }

 private:
  static constexpr int kBaseQ = 3, kArmQ = 7, kWheelQ = 10;
  static constexpr int kBaseU = 3, kArmU = 6, kWheelU = 9;
  static int jointQ(int i) { return i < kWheelCount ? kWheelQ + i : kArmQ + i - kWheelCount; }
  static int jointU(int i) { return i < kWheelCount ? kWheelU + i : kArmU + i - kWheelCount; }
  static int rotorQ(int i) { return kWheelQ + kWheelCount + i; }
  static int rotorU(int i) { return kWheelU + kWheelCount + i; }

  void addBodies() {
    // A carriage without mass at the ball's centre: it moves, ball and base turn in it.
    MobilizedBody carriage = MobilizedBody::Translation(matter_.Ground(), SimTK::Body::Massless());
    bodies_[kBaseBody] = MobilizedBody::Ball(
        carriage, toBody(withoutRotors(robot_.base, kBaseBody, robot_, options_), "the base"));
    const auto links = linksWithoutRotors(robot_, options_);
    for (int j = 0; j < kArmJointCount; ++j) {
      const ArmLink& link = robot_.arm[j];
      bodies_[kLink1Body + j] = armJoint(bodies_[kBaseBody + j], link, toBody(links[j], link.name));
    }
    for (int i = 0; i < kWheelCount; ++i) {
      turning_.push_back(addWheel(bodies_[kBaseBody], robot_, i));
    }
    const auto mounts = actuatorMounts(robot_);
    for (int i = 0; options_.rotors && i < kJointCount; ++i) {
      turning_.push_back(addRotor(bodies_[mounts[i].parent], mounts[i], options_.rotor_inertia[i]));
    }
    BodyInertia ball;
    ball.mass = robot_.ball.mass;
    ball.I_LLcm_L = robot_.ball.inertia * Matrix3::Identity();
    bodies_[kBallBody] = MobilizedBody::Ball(carriage, toBody(ball, "the ball"));
  }

  Matrix3 rotationFromQ(const double* q) const {
    q += kBaseQ;
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
  }

  Vector3 rollingRates(const Matrix3& R_WB, const double* u) const {
    const Vector3 relative_B = R_WB.transpose() * (Eigen::Map<const Vector3>(u + ball_u_) -
                                                   Eigen::Map<const Vector3>(u + kBaseU));
    Vector3 rates;
    for (int i = 0; i < kWheelCount; ++i) rates[i] = -ratio_ * robot_.wheelAxle(i).dot(relative_B);
    return rates;
  }

  void collectForces(const MultibodyLoads& loads) {
    mobility_forces_.resize(nu_);
    mobility_forces_ = 0;
    body_forces_.resize(matter_.getNumBodies());
    body_forces_ = SpatialVec(Vec3(0), Vec3(0));
    for (const MobilizedBody* body : gravity_points_) {
      body->applyForceToBodyPoint(state_, body->getBodyMassCenterStation(state_),
                                  Vec3(0, 0, -robot_.gravity * body->getBodyMass(state_)),
                                  body_forces_);
    }
    const FloorLoad floor = floorLoad(loads.spin_lever);
    SpatialVec& on_ball = body_forces_[bodies_[kBallBody].getMobilizedBodyIndex()];
    on_ball += SpatialVec(toSimTK(floor.torque), toSimTK(floor.force));
    for (const PointForce& f : loads.forces) {
      const Vector3 arm = body(f.body).R_WL * f.p_BP_B;
      body_forces_[bodies_[f.body].getMobilizedBodyIndex()] +=
          SpatialVec(toSimTK(arm.cross(f.force_W)), toSimTK(f.force_W));
    }
    for (int i = 0; i < kJointCount; ++i) {
      mobility_forces_[jointU(i)] = loads.joint_torque[i];
      if (options_.rotors)
        mobility_forces_[rotorU(i)] = loads.rotor_torque[i] / options_.gear_ratio[i];
    }
  }

  /// Adds to udot what three rows G udot = bias demand; multipliers from G M^-1 G^T.
  void rollWheelsOnBall() {
    const BodyMotion base = body(kBaseBody);
    const Vector3 turning = base.w_WL_W.cross(body(kBallBody).w_WL_W);
    std::array<Vector3, kWheelCount> rows;  // of the ball's rate; the base's has the other sign
    for (int i = 0; i < kWheelCount; ++i) rows[i] = ratio_ * (base.R_WL * robot_.wheelAxle(i));
    const auto rowTimes = [&](int i, const SimTK::Vector& v) {
      double sum = v[kWheelU + i];
      for (int k = 0; k < 3; ++k) sum += rows[i][k] * (v[ball_u_ + k] - v[kBaseU + k]);
      return sum;
    };
    SmallMatrix<kWheelCount> A{};
    SmallVector<kWheelCount> multipliers{};
    for (int i = 0; i < kWheelCount; ++i) {
      row_ = 0;
      row_[kWheelU + i] = 1;
      for (int k = 0; k < 3; ++k) {
        row_[ball_u_ + k] = rows[i][k];
        row_[kBaseU + k] = -rows[i][k];
      }
      matter_.multiplyByMInv(state_, row_, response_[i]);
      for (int j = i; j < kWheelCount; ++j) A[j][i] = rowTimes(j, response_[i]);
      multipliers[i] = rows[i].dot(turning) - rowTimes(i, udot_);
    }
    solveCholesky<kWheelCount>(A, multipliers, kWheelCount);
    for (int i = 0; i < kWheelCount; ++i) udot_ += multipliers[i] * response_[i];
  }

  RobotParameters robot_;
  MultibodyOptions options_;
  FloorContact floor_;
  double ratio_;  ///< r / r_w
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::State state_;
  std::array<MobilizedBody, kBodyCount> bodies_;
  std::vector<MobilizedBody> turning_;  ///< wheels, then rotors
  std::vector<const MobilizedBody*> gravity_points_;
  double mass_ = 0;
  int nq_ = 0, nu_ = 0, ball_q_ = 0, ball_u_ = 0;
  SimTK::Vector mobility_forces_, udot_, row_;
  SimTK::Vector_<SpatialVec> body_forces_, body_acceleration_;
  std::array<SimTK::Vector, kWheelCount> response_;
};

}  // namespace

std::unique_ptr<Multibody> makeCompliantMultibody(const RobotParameters& robot,
                                                  const MultibodyOptions& options) {
  return std::make_unique<CompliantMultibody>(robot, options);
}

}  // namespace ballbot
