#include "structure_a.hpp"

#include <array>

#include <Eigen/Geometry>
#include <Simbody.h>

#include "model/frames.hpp"

namespace ballbot {
namespace {

using SimTK::Constraint;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::SpatialVec;
using SimTK::Transform;
using SimTK::UnitVec3;
using SimTK::Vec3;

Vec3 vec(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Vector3 vec(const Vec3& v) { return {v[0], v[1], v[2]}; }

SimTK::Body rigid(const BodyInertia& b) {
  const SimTK::Inertia central(b.I_LLcm_L(0, 0), b.I_LLcm_L(1, 1), b.I_LLcm_L(2, 2),
                               b.I_LLcm_L(0, 1), b.I_LLcm_L(0, 2), b.I_LLcm_L(1, 2));
  const Vec3 c = vec(b.p_LLcm_L);
  return SimTK::Body::Rigid(
      SimTK::MassProperties(b.mass, c, central.shiftFromMassCenter(-c, b.mass)));
}

Transform pin(const Vector3& axis, const Vector3& p) {
  return {Rotation(UnitVec3(vec(axis)), SimTK::ZAxis), vec(p)};
}

}  // namespace

struct StructureA::Impl {
  explicit Impl(const RobotParameters& r) : robot(r), matter(system) {
    BodyInertia ball_inertia;
    ball_inertia.mass = r.ball.mass;
    ball_inertia.I_LLcm_L = r.ball.inertia * Matrix3::Identity();
    ball = MobilizedBody::Free(matter.Ground(), rigid(ball_inertia));
    base = MobilizedBody::Ball(ball, rigid(r.base));
    for (int i = 0; i < kWheelCount; ++i) {
      const Vector3 d = r.wheelAxle(i);
      BodyInertia wheel;
      wheel.mass = r.wheels.mass;
      wheel.I_LLcm_L = r.wheels.transverse_inertia * Matrix3::Identity() +
                       (r.wheels.spin_inertia - r.wheels.transverse_inertia) * d * d.transpose();
      joints[i] =
          MobilizedBody::Pin(base, pin(d, r.wheelCentre(i)), rigid(wheel), pin(d, Vector3::Zero()));
    }
    for (int j = 0; j < kArmJointCount; ++j) {
      const BodyInertia inertia =
          j + 1 < kArmJointCount ? r.arm[j].inertia : r.lastLinkWithPayload();
      MobilizedBody& parent = j == 0 ? base : joints[kWheelCount + j - 1];
      joints[kWheelCount + j] =
          MobilizedBody::Pin(parent, pin(r.arm[j].axis, r.arm[j].p_PJ_P), rigid(inertia),
                             pin(r.arm[j].axis, Vector3::Zero()));
    }
    // The plane's frame has its normal along z; the ball's centre rides one radius above it.
    Constraint::SphereOnPlaneContact(matter.Ground(), Transform(), ball, Vec3(0), r.ball.radius,
                                     true);
    Constraint::ConstantSpeed(ball, SimTK::MobilizerUIndex(2), 0);
    for (int i = 0; i < kWheelCount; ++i) {
      const Vector3 c = r.contactDirection(i);
      Constraint::NoSlip1D(base, vec(Vector3(r.ball.radius * c)),
                           UnitVec3(vec(Vector3(c.cross(r.wheelAxle(i))))), ball, joints[i]);
    }
    state = system.realizeTopology();
    system.realizeModel(state);
  }

  RobotParameters robot;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  MobilizedBody ball, base;
  std::array<MobilizedBody, kJointCount> joints;
  SimTK::State state;
};

StructureA::StructureA(const RobotParameters& robot) : impl_(std::make_unique<Impl>(robot)) {}
StructureA::~StructureA() = default;

StructureA::Acceleration StructureA::acceleration(const RobotPose& pose, const VelocityVector& nu,
                                                  const MultibodyLoads& loads) {
  SimTK::State& s = impl_->state;
  const double r = impl_->robot.ball.radius;
  const Matrix3 R = rotationFromYawPitchRoll(pose.yaw, pose.pitch, pose.roll);
  Rotation R_WB(
      SimTK::Mat33(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
      true);
  const Vec3 v(nu[kBallVx], nu[kBallVy], 0), w_ball(-v[1] / r, v[0] / r, 0);
  impl_->ball.setQToFitTransform(s, Transform(Vec3(pose.px, pose.py, r)));
  impl_->ball.setUToFitVelocity(s, SpatialVec(w_ball, v));
  impl_->base.setQToFitRotation(s, R_WB);
  impl_->base.setUToFitAngularVelocity(s, vec(Vector3(R * nu.segment<3>(kOmegaX))) - w_ball);
  for (int j = 0; j < kArmJointCount; ++j) {
    impl_->joints[kWheelCount + j].setOneQ(s, 0, pose.arm[j]);
    impl_->joints[kWheelCount + j].setOneU(s, 0, nu[kArmRate1 + j]);
  }
  // A wheel's rim goes with the ball's surface: both velocities in the base, along the tangent.
  const Vector3 ball_in_base = R.transpose() * vec(w_ball) - nu.segment<3>(kOmegaX);
  for (int i = 0; i < kWheelCount; ++i) {
    const Vector3 c = impl_->robot.contactDirection(i), d = impl_->robot.wheelAxle(i);
    const Vector3 t = c.cross(d);
    const double rim = t.dot(ball_in_base.cross(r * c));
    const double rim_per_rate = t.dot(d.cross(-impl_->robot.wheels.radius * c));
    impl_->joints[i].setOneU(s, 0, rim / rim_per_rate);
  }

  impl_->system.realize(s, SimTK::Stage::Dynamics);
  SimTK::Vector mobility(s.getNU(), 0.0), udot;
  SimTK::Vector_<SpatialVec> forces(impl_->matter.getNumBodies(), SpatialVec(Vec3(0), Vec3(0))), A;
  for (SimTK::MobilizedBodyIndex i(1); i < impl_->matter.getNumBodies(); ++i) {
    const MobilizedBody& b = impl_->matter.getMobilizedBody(i);
    b.applyForceToBodyPoint(s, b.getBodyMassCenterStation(s),
                            Vec3(0, 0, -impl_->robot.gravity * b.getBodyMass(s)), forces);
  }
  for (int i = 0; i < kJointCount; ++i) {
    impl_->joints[i].applyOneMobilityForce(s, 0, loads.joint_torque[i], mobility);
  }
  for (const PointForce& f : loads.forces) {
    const MobilizedBody& b = f.body == kBallBody ? impl_->ball
                             : f.body == kBaseBody
                                 ? impl_->base
                                 : impl_->joints[kWheelCount + f.body - kLink1Body];
    b.applyForceToBodyPoint(s, vec(f.p_BP_B), vec(f.force_W), forces);
  }
  impl_->matter.calcAcceleration(s, mobility, forces, udot, A);

  Acceleration out;
  out.a_WK_W = vec(A[impl_->ball.getMobilizedBodyIndex()][1]);
  out.alpha_WB_W = vec(A[impl_->base.getMobilizedBodyIndex()][0]);
  for (int i = 0; i < kJointCount; ++i) {
    out.joints[i] = udot[impl_->joints[i].getFirstUIndex(s)];
  }
  return out;
}

double StructureA::velocityError() const { return impl_->state.getUErr().normInf(); }

}  // namespace ballbot
