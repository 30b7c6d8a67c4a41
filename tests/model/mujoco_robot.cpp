#include "tests/model/mujoco_robot.hpp"

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

namespace ballbot {
namespace {

constexpr int kBodyDofs = 6 + 6 + kWheelCount + kArmJointCount;
using FullVector = Eigen::Matrix<double, kBodyDofs, 1>;
using FullMatrix = Eigen::Matrix<double, kBodyDofs, kBodyDofs, Eigen::RowMajor>;
using PointJacobian = Eigen::Matrix<double, 3, kBodyDofs, Eigen::RowMajor>;

std::string inertial(const BodyInertia& body) {
  const Matrix3& I = body.I_LLcm_L;
  return fmt::format(
      "<inertial pos='{:.17g} {:.17g} {:.17g}' mass='{:.17g}' fullinertia='{:.17g} {:.17g} {:.17g} "
      "{:.17g} {:.17g} {:.17g}'/>",
      body.p_LLcm_L.x(), body.p_LLcm_L.y(), body.p_LLcm_L.z(), body.mass, I(0, 0), I(1, 1), I(2, 2),
      I(0, 1), I(0, 2), I(1, 2));
}

std::string vectorText(const Vector3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

std::string modelXml(const RobotParameters& robot) {
  std::string arm;
  for (int i = kArmJointCount - 1; i >= 0; --i) {
    const ArmLink& link = robot.arm[i];
    const bool last = i == kArmJointCount - 1;
    arm = fmt::format(
        "<body name='arm_{}' pos='{}'>{}<joint name='arm_{}' type='{}' axis='{}'/>{}</body>", i,
        vectorText(link.p_PJ_P), inertial(last ? robot.lastLinkWithPayload() : link.inertia), i,
        link.slides() ? "slide" : "hinge", vectorText(link.axis), arm);
  }
  std::string wheels;
  for (int i = 0; i < kWheelCount; ++i) {
    const Vector3 d = robot.wheelAxle(i);
    BodyInertia disc;
    disc.mass = robot.wheels.mass;
    disc.I_LLcm_L = robot.wheels.transverse_inertia * (Matrix3::Identity() - d * d.transpose()) +
                    robot.wheels.spin_inertia * d * d.transpose();
    wheels += fmt::format("<body pos='{}'>{}<joint name='wheel_{}' axis='{}'/></body>",
                          vectorText(robot.wheelCentre(i)), inertial(disc), i, vectorText(d));
  }
  BodyInertia ball;
  ball.mass = robot.ball.mass;
  ball.I_LLcm_L = robot.ball.inertia * Matrix3::Identity();
  return fmt::format(
      "<mujoco><compiler inertiafromgeom='false' angle='radian'/>"
      "<option gravity='0 0 {:.17g}'><flag contact='disable' constraint='disable'/></option>"
      "<worldbody>"
      "<body name='ball'>{}<freejoint name='ball'/></body>"
      "<body name='base'>{}<freejoint name='base'/>{}{}</body>"
      "</worldbody></mujoco>",
      -robot.gravity, inertial(ball), inertial(robot.base), wheels, arm);
}

mjModel* compile(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "robot.xml", static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char error[1000] = "";
  mjModel* model = mj_loadXML("robot.xml", files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(error);
  return model;
}

}  // namespace

class MujocoRobot::Impl {
 public:
  explicit Impl(const RobotParameters& robot)
      : robot_(robot), model_(compile(modelXml(robot))), data_(mj_makeData(model_)) {
    if (model_->nv != kBodyDofs) throw std::runtime_error("unexpected number of velocities");
    ball_ = dof("ball");
    base_ = dof("base");
    for (int i = 0; i < kWheelCount; ++i) wheel_[i] = dof(fmt::format("wheel_{}", i));
    for (int i = 0; i < kArmJointCount; ++i) arm_[i] = dof(fmt::format("arm_{}", i));
    last_link_ = mj_name2id(model_, mjOBJ_BODY, fmt::format("arm_{}", kArmJointCount - 1).c_str());
  }
  ~Impl() {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }

  /// kVelocities: 8, or 9 where the ball may spin.
  template <int kVelocities>
  Eigen::Matrix<double, kVelocities, 1> acceleration(const PositionVector& q,
                                                     const SpinningVelocityVector& nu,
                                                     const JointVector& tau, const Vector3& lambda,
                                                     double floor_torque) {
    const Eigen::Quaterniond orientation = Eigen::AngleAxisd(q[kYaw], Vector3::UnitZ()) *
                                           Eigen::AngleAxisd(q[kPitch], Vector3::UnitY()) *
                                           Eigen::AngleAxisd(q[kRoll], Vector3::UnitX());
    R_WB_ = orientation.toRotationMatrix();
    place("ball", q, Eigen::Quaterniond::Identity());
    place("base", q, orientation);
    for (int i = 0; i < kArmJointCount; ++i) {
      const int joint = mj_name2id(model_, mjOBJ_JOINT, fmt::format("arm_{}", i).c_str());
      data_->qpos[model_->jnt_qposadr[joint]] = perAngle(i) * q[kArm1 + i];
    }

    Eigen::Matrix<double, kBodyDofs, kVelocities> A;  // all velocities = A nu
    for (int k = 0; k < kVelocities; ++k) A.col(k) = allVelocities(SpinningVelocityVector::Unit(k));
    Eigen::Map<FullVector>(data_->qvel) = A * nu.head<kVelocities>();
    // dA/dt nu: the ball's axes of rotation turn against the base, so the wheel rates change even
    // when nu does not.
    FullVector drift = FullVector::Zero();
    const Vector3 omega = nu.segment<3>(kOmegaX);
    for (int i = 0; i < kWheelCount; ++i) {
      drift[wheel_[i]] = wheelRate(i, -omega.cross(ballRateInBase(nu)), Vector3::Zero());
    }

    mj_forward(model_, data_);
    FullMatrix M;
    mj_fullM(model_, M.data(), data_->qM);
    const Eigen::Map<const FullVector> bias(data_->qfrc_bias);
    FullVector applied = FullVector::Zero();
    for (int i = 0; i < kWheelCount; ++i) applied[wheel_[i]] = tau[i];
    for (int i = 0; i < kArmJointCount; ++i) {
      applied[arm_[i]] = tau[kWheelCount + i] / perAngle(i);
    }
    applied[ball_ + 5] = floor_torque;
    PointJacobian J;
    const Vector3 p = endEffectorPosition();
    mj_jac(model_, data_, J.data(), nullptr, p.data(), last_link_);
    applied += J.transpose() * lambda;
    return (A.transpose() * M * A).ldlt().solve(A.transpose() * (applied - bias - M * drift));
  }

  Vector3 endEffectorPosition() const {
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    const Eigen::Map<const Vector3> origin(data_->xpos + 3 * last_link_);
    const Eigen::Map<const RowMajor> R(data_->xmat + 9 * last_link_);
    return origin + R * robot_.p_A3E;
  }

 private:
  int dof(const std::string& joint) const {
    return model_->jnt_dofadr[mj_name2id(model_, mjOBJ_JOINT, joint.c_str())];
  }

  /// Of MuJoCo's coordinate of an arm joint: it counts what slides in metres.
  double perAngle(int i) const { return robot_.arm[i].slides() ? robot_.arm[i].lead : 1; }

  void place(const char* joint, const PositionVector& q, const Eigen::Quaterniond& orientation) {
    double* qpos = data_->qpos + model_->jnt_qposadr[mj_name2id(model_, mjOBJ_JOINT, joint)];
    const double values[7] = {q[kBallX],       q[kBallY],       robot_.ball.radius, orientation.w(),
                              orientation.x(), orientation.y(), orientation.z()};
    std::copy(values, values + 7, qpos);
  }

  /// Rolling on the floor, and spinning on the spot.
  Vector3 ballRate(const SpinningVelocityVector& nu) const {
    return Vector3::UnitZ().cross(Vector3(nu[kBallVx], nu[kBallVy], 0)) / robot_.ball.radius +
           Vector3(0, 0, nu[kBallSpin]);
  }
  Vector3 ballRateInBase(const SpinningVelocityVector& nu) const {
    return R_WB_.transpose() * ballRate(nu);
  }

  /// The rate at which wheel i moves along with the ball at their contact, in the direction that
  /// its rollers do not leave free.
  double wheelRate(int i, const Vector3& ball_B, const Vector3& base_B) const {
    const Vector3 c = robot_.contactDirection(i), d = robot_.wheelAxle(i), t = c.cross(d);
    const Vector3 contact = robot_.ball.radius * c;
    const double per_rate = d.cross(contact - robot_.wheelCentre(i)).dot(t);
    return (ball_B - base_B).cross(contact).dot(t) / per_rate;
  }

  FullVector allVelocities(const SpinningVelocityVector& nu) const {
    FullVector v = FullVector::Zero();
    // A free joint's velocity: that of its origin in W, then its rotation in its own axes.
    v.segment<2>(ball_) = v.segment<2>(base_) = nu.head<2>();
    v.segment<3>(ball_ + 3) = ballRate(nu);
    v.segment<3>(base_ + 3) = nu.segment<3>(kOmegaX);
    for (int i = 0; i < kWheelCount; ++i) {
      v[wheel_[i]] = wheelRate(i, ballRateInBase(nu), nu.segment<3>(kOmegaX));
    }
    for (int i = 0; i < kArmJointCount; ++i) v[arm_[i]] = perAngle(i) * nu[kArmRate1 + i];
    return v;
  }

  const RobotParameters robot_;
  mjModel* model_;
  mjData* data_;
  int ball_, base_, wheel_[kWheelCount], arm_[kArmJointCount], last_link_;
  Matrix3 R_WB_ = Matrix3::Identity();
};

MujocoRobot::MujocoRobot(const RobotParameters& robot) : impl_(std::make_unique<Impl>(robot)) {}
MujocoRobot::~MujocoRobot() = default;

VelocityVector MujocoRobot::acceleration(const PositionVector& q, const VelocityVector& nu,
                                         const JointVector& tau, const Vector3& lambda_W) {
  SpinningVelocityVector held;
  held << nu, 0;
  return impl_->acceleration<kVelocityDim>(q, held, tau, lambda_W, 0);
}

SpinningVelocityVector MujocoRobot::acceleration(const PositionVector& q,
                                                 const SpinningVelocityVector& nu,
                                                 const JointVector& tau, const Vector3& lambda_W,
                                                 double floor_torque) {
  return impl_->acceleration<kSpinningVelocityDim>(q, nu, tau, lambda_W, floor_torque);
}

Vector3 MujocoRobot::endEffectorPosition() const { return impl_->endEffectorPosition(); }

}  // namespace ballbot
