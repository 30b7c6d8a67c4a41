#include "plant/robot_tree.hpp"

#include <cmath>
#include <cstring>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

using SimTK::Real;
using SimTK::SpatialVec;
using SimTK::Vec3;

/// Moves in the horizontal plane of its parent: two velocities, no rotation.
class HorizontalMobilizer : public SimTK::MobilizedBody::Custom::Implementation {
 public:
  explicit HorizontalMobilizer(SimTK::SimbodyMatterSubsystem& matter)
      : Implementation(matter, 2, 2, 0) {}
  Implementation* clone() const override { return new HorizontalMobilizer(*this); }
  SimTK::Transform calcMobilizerTransformFromQ(const SimTK::State&, int,
                                               const Real* q) const override {
    return SimTK::Transform(Vec3(q[0], q[1], 0));
  }
  SpatialVec multiplyByHMatrix(const SimTK::State&, int, const Real* u) const override {
    return {Vec3(0), Vec3(u[0], u[1], 0)};
  }
  void multiplyByHTranspose(const SimTK::State&, const SpatialVec& F, int, Real* f) const override {
    f[0] = F[1][0];
    f[1] = F[1][1];
  }
  SpatialVec multiplyByHDotMatrix(const SimTK::State&, int, const Real*) const override {
    return {Vec3(0), Vec3(0)};
  }
  void multiplyByHDotTranspose(const SimTK::State&, const SpatialVec&, int,
                               Real* f) const override {
    f[0] = f[1] = 0;
  }
};

/// Slides along the z axis that its frames share, by so much per angle.
class SlideMobilizer final : public SimTK::MobilizedBody::Custom::Implementation {
 public:
  SlideMobilizer(SimTK::SimbodyMatterSubsystem& matter, double lead)
      : Implementation(matter, 1, 1, 0), lead_(lead) {}
  Implementation* clone() const override { return new SlideMobilizer(*this); }
  SimTK::Transform calcMobilizerTransformFromQ(const SimTK::State&, int,
                                               const Real* q) const override {
    return {Vec3(0, 0, lead_ * q[0])};
  }
  SpatialVec multiplyByHMatrix(const SimTK::State&, int, const Real* u) const override {
    return {Vec3(0), Vec3(0, 0, lead_ * u[0])};
  }
  void multiplyByHTranspose(const SimTK::State&, const SpatialVec& F, int, Real* f) const override {
    f[0] = lead_ * F[1][2];
  }
  SpatialVec multiplyByHDotMatrix(const SimTK::State&, int, const Real*) const override {
    return {Vec3(0), Vec3(0)};
  }
  void multiplyByHDotTranspose(const SimTK::State&, const SpatialVec&, int,
                               Real* f) const override {
    f[0] = 0;
  }
  void setQToFitTransform(const SimTK::State&, const SimTK::Transform& X, int,
                          Real* q) const override {
    q[0] = X.p()[2] / lead_;
  }
  void setUToFitVelocity(const SimTK::State&, const SpatialVec& V, int, Real* u) const override {
    u[0] = V[1][2] / lead_;
  }

 private:
  double lead_;
};

/// A library built with NDEBUG does not look, so we do.
void requireRigidBody(const BodyInertia& b, const std::string& name) {
  const Vector3 m = Eigen::SelfAdjointEigenSolver<Matrix3>(b.I_LLcm_L).eigenvalues();  // rising
  const double rounding = 1e-9 * std::abs(m.sum());
  // Written so that NaN does not pass.
  if (b.mass >= 0 && m[0] >= -rounding && m[0] + m[1] >= m[2] - rounding) return;
  throw InputError(
      fmt::format("the inertia of {} is not that of a rigid body once wheels and rotors are taken "
                  "apart: its mass is "
                  "{:.4g} kg, its principal moments about its centre of mass are {:.4g}, {:.4g} "
                  "and {:.4g} kg m^2; none "
                  "may be negative, and none larger than the sum of the other two",
                  name, b.mass, m[0], m[1], m[2]));
}

}  // namespace

Matrix3 toEigen(const SimTK::Rotation& R) {
  Matrix3 out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out(i, j) = R[i][j];
  }
  return out;
}

SimTK::Body toBody(const BodyInertia& b, const std::string& name) {
  requireRigidBody(b, name);
  const Vector3& c = b.p_LLcm_L;
  const Matrix3 I =
      b.I_LLcm_L + b.mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
  return SimTK::Body::Rigid(SimTK::MassProperties(
      b.mass, toSimTK(c), SimTK::Inertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2))));
}

SimTK::Transform pinFrame(const Vector3& axis, const Vector3& p) {
  return {SimTK::Rotation(SimTK::UnitVec3(toSimTK(axis)), SimTK::ZAxis), toSimTK(p)};
}

SimTK::MobilizedBody armJoint(SimTK::MobilizedBody& parent, const ArmLink& link,
                              const SimTK::Body& body) {
  const SimTK::Transform inboard = pinFrame(link.axis, link.p_PJ_P);
  const SimTK::Transform outboard = pinFrame(link.axis, Vector3::Zero());
  if (!link.slides()) return SimTK::MobilizedBody::Pin(parent, inboard, body, outboard);
  SimTK::SimbodyMatterSubsystem& matter = parent.updMatterSubsystem();
  return SimTK::MobilizedBody::Custom(parent, new SlideMobilizer(matter, link.lead), inboard, body,
                                      outboard);
}

BodyInertia without(const BodyInertia& whole, BodyInertia part, const Vector3& p_WP) {
  part.mass = -part.mass;
  part.I_LLcm_L = -part.I_LLcm_L;
  return composed(whole, part, p_WP);
}

RobotTree::RobotTree(const RobotParameters& robot, const BodyInertia& base,
                     const std::array<BodyInertia, kArmJointCount>& links, bool ball_spin)
    : matter(system),
      ball_radius_(robot.ball.radius),
      gravity_(robot.gravity),
      ball_spin_(ball_spin) {
  const double r = robot.ball.radius;
  BodyInertia rolling;  // of the ball, as far as its rolling goes
  rolling.mass = robot.ball.mass + robot.ball.inertia / (r * r);
  const BodyInertia nothing;
  SimTK::MobilizedBody::Custom carriage(
      matter.Ground(), new HorizontalMobilizer(matter), SimTK::Transform(Vec3(0, 0, r)),
      toBody(ball_spin ? nothing : rolling, "the ball"), SimTK::Transform());
  bodies_[kBallBody] = carriage;
  bodies_[kBaseBody] = SimTK::MobilizedBody::Ball(carriage, toBody(base, "the base"));
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmLink& link = robot.arm[j];
    bodies_[kLink1Body + j] = armJoint(bodies_[kBaseBody + j], link, toBody(links[j], link.name));
  }
  if (ball_spin) {
    rolling.I_LLcm_L = robot.ball.inertia * Matrix3::Identity();
    bodies_[kBallBody] = SimTK::MobilizedBody::Pin(carriage, toBody(rolling, "the ball"));
  }
  for (int b = 0; b < kBodyCount; ++b) index_[b] = bodies_[b].getMobilizedBodyIndex();

  const BodyInertia whole_base = robot.baseWithWheels();
  weight_[kBallBody].mass = robot.ball.mass;
  weight_[kBaseBody] = {whole_base.mass, whole_base.p_LLcm_L};
  for (int j = 0; j < kArmJointCount; ++j) {
    const BodyInertia& link = robot.arm[j].inertia;
    arm_slides_[j] = robot.arm[j].slides();
    arm_axis_[j] = arm_slides_[j] ? robot.arm[j].slide() : robot.arm[j].axis;
    weight_[kLink1Body + j] = {link.mass, link.p_LLcm_L};
  }
  const BodyInertia last = robot.lastLinkWithPayload();
  weight_[kHandBody] = {last.mass, last.p_LLcm_L};
}

void RobotTree::finishTopology() {
  state = system.realizeTopology();
  system.realizeModel(state);
  system.realize(state, SimTK::Stage::Instance);
  nq_ = state.getNQ();
  nu_ = state.getNU();
  mobility_forces_.resize(nu_);
  body_forces_.resize(matter.getNumBodies());
}

void RobotTree::realize(const double* q, const double* u) {
  // The end of one step is the start of the next; what is realized already stays so.
  const std::size_t q_bytes = nq_ * sizeof(double), u_bytes = nu_ * sizeof(double);
  if (realized_ && std::memcmp(&state.getQ()[0], q, q_bytes) == 0) {
    if (std::memcmp(&state.getU()[0], u, u_bytes) == 0) return;
    std::memcpy(&state.updU()[0], u, u_bytes);
  } else {
    std::memcpy(&state.updQ()[0], q, q_bytes);
    std::memcpy(&state.updU()[0], u, u_bytes);
  }
  realized_ = false;  // in case the next line throws
  system.realize(state, SimTK::Stage::Velocity);
  realized_ = true;
  for (int b = kBaseBody; b < kBodyCount; ++b) {
    const SimTK::Transform& X = bodies_[b].getBodyTransform(state);
    const SpatialVec& V = bodies_[b].getBodyVelocity(state);
    motion_[b] = {toEigen(X.p()), toEigen(X.R()), toEigen(V[1]), toEigen(V[0])};
  }
  const BodyMotion& base = motion_[kBaseBody];
  base_motion_ = {base.p_WL, base.R_WL, base.v_WL_W, base.w_WL_W, ball_spin_ ? u[kSpinU] : 0};
  motion_[kBallBody].p_WL = base.p_WL;
  motion_[kBallBody].v_WL_W = base.v_WL_W;
  motion_[kBallBody].w_WL_W = {-u[1] / ball_radius_, u[0] / ball_radius_, base_motion_.ball_spin};
}

void RobotTree::collectForces(const MultibodyLoads& loads) {
  mobility_forces_ = 0;
  body_forces_ = SpatialVec(Vec3(0), Vec3(0));
  double* mobility = &mobility_forces_[0];
  SpatialVec* on_body = &body_forces_[0];
  for (int b = kBaseBody; b < kBodyCount; ++b) {  // the ball's weight acts on the floor only
    const Vector3 weight{0, 0, -gravity_ * weight_[b].mass};
    const Vector3 arm = motion_[b].R_WL * weight_[b].p_LLcm_L;
    on_body[index_[b]] += SpatialVec(toSimTK(arm.cross(weight)), toSimTK(weight));
  }
  for (const PointForce& f : loads.forces) {
    if (f.body == kBallBody) {
      // Virtual work of force and torque on a ball that rolls: v = (vx, vy), w = (-vy, vx)/r.
      const Vector3 torque = f.p_BP_B.cross(f.force_W);
      mobility[0] += f.force_W.x() + torque.y() / ball_radius_;
      mobility[1] += f.force_W.y() - torque.x() / ball_radius_;
      if (ball_spin_) mobility[kSpinU] += torque.z();
    } else {
      const Vector3 arm = motion_[f.body].R_WL * f.p_BP_B;
      on_body[index_[f.body]] += SpatialVec(toSimTK(arm.cross(f.force_W)), toSimTK(f.force_W));
    }
  }
  if (ball_spin_) mobility[kSpinU] += loads.ball_spin_torque;
  for (int j = 0; j < kArmJointCount; ++j) {
    mobility[kArmU + j] += loads.joint_torque[kWheelCount + j];
  }
}

void RobotTree::addTorque(BodyIndex body, const Vector3& torque_W) {
  body_forces_[index_[body]][0] += toSimTK(torque_W);
}

void RobotTree::place(const RobotPose& pose, double* q, double* u) const {
  std::fill(q, q + nq_, 0.0);
  std::fill(u, u + nu_, 0.0);
  q[0] = pose.px;
  q[1] = pose.py;
  const Eigen::Quaterniond quat(rotationFromYawPitchRoll(pose.yaw, pose.pitch, pose.roll));
  q += kQuaternionQ;
  q[0] = quat.w();
  q[1] = quat.x();
  q[2] = quat.y();
  q[3] = quat.z();
  Eigen::Map<ArmVector>(q + 4) = pose.arm;
}

void RobotTree::setVelocity(const double* q, const VelocityVector& nu, double ball_spin,
                            double* u) const {
  u[0] = nu[kBallVx];
  u[1] = nu[kBallVy];
  if (ball_spin_) u[kSpinU] = ball_spin;
  Eigen::Map<Vector3>(u + kOmegaU) = rotationFromQ(q) * nu.segment<3>(kOmegaX);
  Eigen::Map<ArmVector>(u + kArmU) = nu.tail<kArmJointCount>();
}

Matrix3 RobotTree::rotationFromQ(const double* q) const {
  q += kQuaternionQ;
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

void RobotTree::normalizeQuaternion(double* q) const {
  Eigen::Map<Eigen::Vector4d> quat(q + kQuaternionQ);
  quat /= quat.norm();
}

Vector3 RobotTree::carriedLoad(const MultibodyLoads& loads,
                               const SimTK::Vector_<SimTK::SpatialVec>& body_acceleration) const {
  const SpatialVec* acceleration = &body_acceleration[0];
  Vector3 load = Vector3::Zero();
  for (int b = kBaseBody; b < kBodyCount; ++b) {
    const SpatialVec& A = acceleration[index_[b]];
    const Vector3 arm = motion_[b].R_WL * weight_[b].p_LLcm_L;
    const Vector3& w = motion_[b].w_WL_W;
    load += weight_[b].mass * (toEigen(A[1]) + toEigen(A[0]).cross(arm) + w.cross(w.cross(arm)) +
                               Vector3(0, 0, gravity_));
  }
  for (const PointForce& f : loads.forces) {
    if (f.body != kBallBody) load -= f.force_W;
  }
  return load;
}

Vector3 RobotTree::carriedMomentum(const double* u) const {
  Vector3 v(u[0], u[1], 0), w(u[kOmegaU], u[kOmegaU + 1], u[kOmegaU + 2]);  // of body after body
  Vector3 momentum = Vector3::Zero();
  for (int b = kBaseBody; b < kBodyCount; ++b) {
    if (b > kBaseBody) {
      const int j = b - kLink1Body;
      v += w.cross(motion_[b].p_WL - motion_[b - 1].p_WL);
      if (arm_slides_[j]) {
        v += u[kArmU + j] * (motion_[b].R_WL * arm_axis_[j]);
      } else {
        w += u[kArmU + j] * (motion_[b].R_WL * arm_axis_[j]);
      }
    }
    momentum += weight_[b].mass * (v + w.cross(motion_[b].R_WL * weight_[b].p_LLcm_L));
  }
  return momentum;
}

double RobotTree::potentialEnergy() const {
  double energy = 0;
  for (int b = 0; b < kBodyCount; ++b) {
    const Vector3 p = motion_[b].p_WL + motion_[b].R_WL * weight_[b].p_LLcm_L;
    energy += weight_[b].mass * gravity_ * p.z();
  }
  return energy;
}

}  // namespace ballbot
