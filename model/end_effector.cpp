#include "model/end_effector.hpp"

namespace ballbot {

namespace {

using Pass = NewtonEuler<double>;

void setColumn(EndEffectorJacobian& J, int column, const Vector3& top, const Vector3& bottom) {
  J.block<3, 1>(0, column) = top;
  J.block<3, 1>(3, column) = bottom;
}

}  // namespace

ReducedDynamics::EndEffector endEffectorOf(const DynamicsConstants& constants, const Pass& pass,
                                           const StateVector& x) {
  const Motion<double>& tip = pass.velocity.back();
  ReducedDynamics::EndEffector out;
  out.p_WE = Vector3(x[kBallX], x[kBallY], constants.ball_radius) + pass.R_WB * pass.p_KE;
  out.R_WE = pass.R_WB * pass.R_BA3 * constants.R_A3E;
  out.v_WE_W = pass.R_WB * (tip.linear + cross(tip.angular, pass.p_KE));
  out.v_WE_W.head<2>() += x.segment<2>(kPositionDim + kBallVx);
  out.w_WE_W = pass.R_WB * tip.angular;
  return out;
}

void linearizeEndEffectorOf(const DynamicsConstants& constants, const Pass& pass,
                            const StateVector& x, ReducedDynamics::EndEffectorLinearization& out) {
  const Matrix3& R = pass.R_WB;
  out.value = endEffectorOf(constants, pass, x);
  const Vector3& w = out.value.w_WE_W;
  Vector3 p = out.value.p_WE, v = out.value.v_WE_W;  // from K, and relative to it
  p -= Vector3(x[kBallX], x[kBallY], constants.ball_radius);
  v.head<2>() -= x.segment<2>(kPositionDim + kBallVx);

  out.jacobian(0, kBallVx) = out.jacobian(1, kBallVy) = 1;
  out.dpose_dq(0, kBallX) = out.dpose_dq(1, kBallY) = 1;
  // The whole robot turns about axes of B for nu, and about those of yaw, pitch and roll for q.
  const Vector3 euler_axis[3] = {Vector3::UnitZ(), {-pass.sin_yaw, pass.cos_yaw, 0}, R.col(0)};
  for (int k = 0; k < 3; ++k) {
    const Vector3 axis = R.col(k);
    setColumn(out.jacobian, kOmegaX + k, cross(axis, p), axis);
    setColumn(out.dpose_dq, kYaw + k, cross(euler_axis[k], p), euler_axis[k]);
    setColumn(out.dtwist_dq, kYaw + k, cross(euler_axis[k], v), cross(euler_axis[k], w));
  }
  // A joint turns what lies beyond it, with its velocity relative to the joint.
  Vector3 v_beyond = Vector3::Zero();  // of E in B, by the joints beyond this one
  for (int i = kArmJointCount - 1; i >= 0; --i) {
    const Vector3 axis = pass.joint[i].angular, tip = pass.tipVelocity(i);
    const Vector3 w_link = pass.velocity[i + 1].angular;
    const Vector3 w_beyond = pass.velocity.back().angular - w_link;
    setColumn(out.jacobian, kArmRate1 + i, R * tip, R * axis);
    setColumn(out.dpose_dq, kArm1 + i, R * tip, R * axis);
    setColumn(out.dtwist_dq, kArm1 + i, R * (cross(w_link, tip) + cross(axis, v_beyond)),
              R * cross(axis, w_beyond));
    v_beyond += tip * pass.rate[i];
  }
}

ReducedDynamics::EndEffector ReducedDynamics::endEffector(const StateVector& x) const {
  return endEffectorOf(*constants_,
                       Pass(*constants_, x.head<kPositionDim>(), x.tail<kVelocityDim>()), x);
}

EndEffectorJacobian ReducedDynamics::endEffectorJacobian(const PositionVector& q) const {
  StateVector x = StateVector::Zero();
  x.head<kPositionDim>() = q;
  EndEffectorLinearization out;
  linearizeEndEffector(x, out);
  return out.jacobian;
}

void ReducedDynamics::linearizeEndEffector(const StateVector& x,
                                           EndEffectorLinearization& out) const {
  const Pass pass(*constants_, x.head<kPositionDim>(), x.tail<kVelocityDim>());
  linearizeEndEffectorOf(*constants_, pass, x, out);
}

}  // namespace ballbot
