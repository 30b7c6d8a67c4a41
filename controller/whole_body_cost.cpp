#include "controller/whole_body_cost.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "controller/weighted_rows.hpp"

namespace ballbot {
namespace {

/// Sum of barrier values, each zero at its reference; the logarithms of what is feasible are taken
/// together, as one.
class BarrierSum {
 public:
  explicit BarrierSum(const RelaxedBarrier& barrier) : barrier_(barrier) {}
  RelaxedBarrier::Derivatives add(double h, double reference, CostTerms& terms) {
    if (h > barrier_.delta) {
      product_ *= h / reference;
      return {0, -barrier_.mu / h, barrier_.mu / (h * h)};
    }
    terms.violation = std::max(terms.violation, -h);
    const RelaxedBarrier::Derivatives d = barrier_.derivatives(h);
    relaxed_ += d.value + barrier_.mu * std::log(reference);
    return d;
  }
  double value() const { return relaxed_ - barrier_.mu * std::log(product_); }

 private:
  const RelaxedBarrier& barrier_;
  double product_ = 1, relaxed_ = 0;
};

/// Both bounds of one coordinate, zero in the middle; first and second derivative of the sum.
struct TwoSided {
  double first, second;
};
TwoSided addTwoSided(BarrierSum& sum, double above_lower, double below_upper, CostTerms& terms) {
  const double reference = 0.5 * (above_lower + below_upper);
  const RelaxedBarrier::Derivatives low = sum.add(above_lower, reference, terms);
  const RelaxedBarrier::Derivatives high = sum.add(below_upper, reference, terms);
  return {low.first - high.first, low.second + high.second};
}

}  // namespace

WholeBodyCost::WholeBodyCost(const RobotParameters& robot, const Constraints& constraints,
                             const TerminalCost& terminal)
    : dynamics_(robot),
      ball_radius_(robot.ball.radius),
      ratio_(robot.ball.radius / robot.wheels.radius),
      constraints_(constraints),
      terminal_(terminal),
      lqr_value_(terminal.kind == TerminalCost::Kind::kLqr
                     ? std::make_shared<const LqrTerminalCost>(robot, terminal)
                     : nullptr),
      sin_tilt_limit_(std::sin(constraints.tilt_limit)),
      cos_tilt_limit_(std::cos(constraints.tilt_limit)) {
  for (int i = 0; i < kWheelCount; ++i) axles_.row(i) = robot.wheelAxle(i).transpose();
}

template <bool kExpand>
void WholeBodyCost::endEffectorCost(const ReducedDynamics::EndEffector& tip,
                                    const EndEffectorLinearization* by_x, const Tasks& tasks,
                                    double share, CostTerms& terms, StateExpansion* out) const {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const OrientationError turn = orientationError(tasks.R_WE, tip.R_WE);
  const Vector3 p_error = tip.p_WE - tasks.p_WE;
  Vector6 twist_error;
  twist_error << tip.v_WE_W - tasks.v_WE_W, tip.w_WE_W - tasks.w_WE_W;
  Vector6 twist_weight;
  twist_weight << tasks.ee_velocity_weight, tasks.ee_rate_weight;
  terms.value[kEndEffectorPositionCost] +=
      0.5 * share * tasks.ee_position_weight.dot(p_error.cwiseAbs2());
  terms.value[kEndEffectorOrientationCost] +=
      0.5 * share * tasks.ee_orientation_weight.dot(turn.e.cwiseAbs2());
  terms.value[kEndEffectorTwistCost] += 0.5 * share * twist_weight.dot(twist_error.cwiseAbs2());
  if constexpr (kExpand) {
    EndEffectorJacobian J = by_x->dpose_dq;
    Matrix3 to_error = 0.5 * turn.eta * Matrix3::Identity();
    to_error(0, 1) = -0.5 * turn.e.z();
    to_error(0, 2) = 0.5 * turn.e.y();
    to_error(1, 2) = -0.5 * turn.e.x();
    to_error(1, 0) = -to_error(0, 1);
    to_error(2, 0) = -to_error(0, 2);
    to_error(2, 1) = -to_error(1, 2);
    J.bottomRows<3>().noalias() = -to_error * by_x->dpose_dq.bottomRows<3>();
    Vector6 weight, error;
    weight << tasks.ee_position_weight, tasks.ee_orientation_weight;
    error.head<3>() = p_error;
    error.tail<3>() = turn.e;
    const Vector6 root = (share * weight).cwiseSqrt();
    WeightedRows pose;
    pose.set(J, root);
    addRowsProduct(pose, pose, *out, 0, 0);
    addRowsGradient(pose, root.cwiseProduct(error), *out, 0);
    if (!twist_weight.isZero(0)) {
      const Vector6 twist_root = (share * twist_weight).cwiseSqrt();
      const Vector6 scaled_error = twist_root.cwiseProduct(twist_error);
      WeightedRows along_q, along_nu;
      along_q.set(by_x->dtwist_dq, twist_root);
      along_nu.set(by_x->jacobian, twist_root);
      addRowsProduct(along_q, along_q, *out, 0, 0);
      addRowsProduct(along_nu, along_q, *out, kPositionDim, 0);
      addRowsProduct(along_nu, along_nu, *out, kPositionDim, kPositionDim);
      addRowsGradient(along_q, scaled_error, *out, 0);
      addRowsGradient(along_nu, scaled_error, *out, kPositionDim);
    }
  }
}

template <bool kExpand>
void WholeBodyCost::coordinateCost(const StateVector& x, const Tasks& tasks, double share,
                                   CostTerms& terms, StateExpansion* out) const {
  const auto square = [&](int i, double weight, double target, CostTerm term) {
    const double w = share * weight, e = x[i] - target;
    terms.value[term] += 0.5 * w * e * e;
    if constexpr (kExpand) {
      out->H(i, i) += w;
      out->g(i) += w * e;
    }
  };
  constexpr int kNu = kPositionDim;
  for (int i = 0; i < 2; ++i) {
    square(kBallX + i, tasks.ball_position_weight[i], tasks.ball_position[i], kBallPositionCost);
    square(kNu + kBallVx + i, tasks.ball_velocity_weight[i], tasks.ball_velocity[i],
           kBallVelocityCost);
  }
  square(kYaw, tasks.yaw_weight, tasks.yaw, kYawCost);
  for (int i = 0; i < 3; ++i) {
    square(kNu + kOmegaX + i, tasks.base_rate_weight[i], 0, kBaseRateCost);
  }
  for (int i = 0; i < kArmJointCount; ++i) {
    square(kArm1 + i, tasks.arm_position_weight[i], tasks.arm_position[i], kArmPositionCost);
    square(kNu + kArmRate1 + i, tasks.arm_rate_weight[i], 0, kArmRateCost);
  }
}

template <bool kExpand>
void WholeBodyCost::armLimitCost(const StateVector& x, const Tasks& tasks, double share,
                                 CostTerms& terms, StateExpansion* out) const {
  constexpr int kNu = kPositionDim;
  const auto expandAt = [&](int i, const TwoSided& d) {
    if constexpr (kExpand) {
      out->H(i, i) += share * d.second;
      out->g(i) += share * d.first;
    }
  };
  BarrierSum position(constraints_.arm_position), rate(constraints_.arm_rate);
  for (int i = 0; i < kArmJointCount; ++i) {
    const double q = x[kArm1 + i], dq = x[kNu + kArmRate1 + i];
    TwoSided d =
        addTwoSided(position, q - constraints_.arm_lower[i], constraints_.arm_upper[i] - q, terms);
    d.first -= tasks.arm_position_wish[i];
    expandAt(kArm1 + i, d);
    expandAt(kNu + kArmRate1 + i, addTwoSided(rate, constraints_.arm_rate_limit + dq,
                                              constraints_.arm_rate_limit - dq, terms));
  }
  terms.value[kArmPositionLimitCost] +=
      share * (position.value() - tasks.arm_position_wish.dot(x.segment<kArmJointCount>(kArm1)));
  terms.value[kArmRateLimitCost] += share * rate.value();
}

template <bool kExpand>
void WholeBodyCost::wheelRateLimitCost(const StateVector& x, double share, CostTerms& terms,
                                       StateExpansion* out) const {
  // phi_dot_i = -rho d_i . (R^T k - w) with k = (-vy, vx, 0) / r the ball's angular velocity in W.
  const double cz = std::cos(x[kYaw]), sz = std::sin(x[kYaw]);
  const double cy = std::cos(x[kPitch]), sy = std::sin(x[kPitch]);
  const double cx = std::cos(x[kRoll]), sx = std::sin(x[kRoll]);
  Matrix3 R_BW;
  R_BW << cz * cy, sz * cy, -sy,                                //
      cz * sy * sx - sz * cx, sz * sy * sx + cz * cx, cy * sx,  //
      cz * sy * cx + sz * sx, sz * sy * cx - cz * sx, cy * cx;
  constexpr int kNu = kPositionDim;
  const double kx = -x[kNu + kBallVy] / ball_radius_, ky = x[kNu + kBallVx] / ball_radius_;
  const Vector3 kappa_B = R_BW.col(0) * kx + R_BW.col(1) * ky;
  const Matrix3 scaled = ratio_ * axles_;
  const Vector3 rates = scaled * (x.segment<3>(kNu + kOmegaX) - kappa_B);

  BarrierSum limits(constraints_.wheel_rate);
  const double limit = constraints_.wheel_rate_limit;
  Vector3 first, second;
  for (int i = 0; i < kWheelCount; ++i) {
    const TwoSided d = addTwoSided(limits, limit + rates[i], limit - rates[i], terms);
    first[i] = d.first;
    second[i] = d.second;
  }
  terms.value[kWheelRateLimitCost] += share * limits.value();
  if constexpr (kExpand) {
    // d(R^T k) = R^T (k x a) for a turn about a: z, then the axis of pitch, then x of B.
    Eigen::Matrix<double, 3, 8> J;
    J.col(0) = R_BW.col(0) * ky - R_BW.col(1) * kx;
    const double along = kx * cz + ky * sz;  // k x (-sz, cz, 0) is vertical
    J.col(1) = R_BW.col(2) * along;
    J.col(2) = kappa_B.cross(Vector3::UnitX());
    J.col(3) = R_BW.col(1) / ball_radius_;
    J.col(4) = -R_BW.col(0) / ball_radius_;
    J.rightCols<3>() = -Matrix3::Identity();
    J = -scaled * J;
    constexpr int kIndex[8] = {kYaw,          kPitch,        kRoll,         kNu + kBallVx,
                               kNu + kBallVy, kNu + kOmegaX, kNu + kOmegaY, kNu + kOmegaZ};
    const Eigen::Matrix<double, 3, 8> weighted = (share * second).asDiagonal() * J;
    for (int c = 0; c < 8; ++c) {
      out->g(kIndex[c]) += share * first.dot(J.col(c));
      for (int r = c; r < 8; ++r) out->H(kIndex[r], kIndex[c]) += weighted.col(c).dot(J.col(r));
    }
  }
}

template <bool kExpand>
void WholeBodyCost::tiltLimitCost(const StateVector& x, double share, CostTerms& terms,
                                  StateExpansion* out) const {
  // h = (cos tilt - cos limit) / sin limit: the margin in rad near the limit, smooth upright.
  const double cos_pitch = std::cos(x[kPitch]), cos_roll = std::cos(x[kRoll]);
  const double cos_tilt = cos_pitch * cos_roll;
  BarrierSum tilt(constraints_.tilt);
  const auto d = tilt.add((cos_tilt - cos_tilt_limit_) / sin_tilt_limit_,
                          (1 - cos_tilt_limit_) / sin_tilt_limit_, terms);
  terms.value[kTiltLimitCost] += share * tilt.value();
  if constexpr (kExpand) {
    const double h_pitch = -std::sin(x[kPitch]) * cos_roll / sin_tilt_limit_;
    const double h_roll = -cos_pitch * std::sin(x[kRoll]) / sin_tilt_limit_;
    const double curvature = std::max(0.0, -d.first * cos_tilt / sin_tilt_limit_);
    out->g(kPitch) += share * d.first * h_pitch;
    out->g(kRoll) += share * d.first * h_roll;
    out->H(kPitch, kPitch) += share * (d.second * h_pitch * h_pitch + curvature);
    out->H(kRoll, kRoll) += share * (d.second * h_roll * h_roll + curvature);
    out->H(kRoll, kPitch) += share * d.second * h_pitch * h_roll;
  }
}

template <bool kExpand>
void WholeBodyCost::stateCost(const StateVector& x, const ReducedDynamics::EndEffector& tip,
                              const EndEffectorLinearization* by_x, const Tasks& tasks,
                              double share, CostTerms& terms, StateExpansion* out) const {
  endEffectorCost<kExpand>(tip, by_x, tasks, share, terms, out);
  coordinateCost<kExpand>(x, tasks, share, terms, out);
  armLimitCost<kExpand>(x, tasks, share, terms, out);
  wheelRateLimitCost<kExpand>(x, share, terms, out);
  tiltLimitCost<kExpand>(x, share, terms, out);
  if (tasks.added != nullptr) addedCost<kExpand>(x, tasks, share, terms, out);
}

template <bool kExpand>
void WholeBodyCost::inputCost(const JointVector& tau, const ContactInput& contact,
                              const Tasks& tasks, double share, CostTerms& terms,
                              InputExpansion* out) const {
  BarrierSum limits(constraints_.torque);
  for (int i = 0; i < kJointCount; ++i) {
    const double limit = constraints_.torque_limit[i];
    const TwoSided d = addTwoSided(limits, limit + tau[i], limit - tau[i], terms);
    const bool arm = i >= kWheelCount;
    const double weight = arm ? tasks.arm_torque_weight : 0;
    const double beyond = arm ? tau[i] - tasks.arm_torque[i - kWheelCount] : 0;
    const double wish = arm ? tasks.arm_torque_wish[i - kWheelCount] : 0;
    terms.value[kArmTorqueCost] += share * (0.5 * weight * beyond - wish) * beyond;
    if constexpr (kExpand) {
      out->gradient[i] = share * (weight * beyond + (d.first - wish));
      out->diagonal[i] = share * (weight + d.second);
    }
  }
  terms.value[kTorqueLimitCost] += share * limits.value();
  forceCost<kExpand>(contact.head<3>(), tasks, share, terms, out);
  const Vector3 weight = tasks.withMoments() ? tasks.contact_moment_weight : Vector3::Ones();
  const Vector3 target = tasks.withMoments() ? tasks.contact_moment_C : Vector3::Zero();
  const Vector3 error = contact.tail<3>() - target;
  terms.value[kContactMomentCost] += 0.5 * share * weight.dot(error.cwiseAbs2());
  if constexpr (kExpand) {
    out->gradient.tail<3>() = share * weight.cwiseProduct(error);
    out->diagonal.tail<3>() = share * weight;
  }
}

template <bool kExpand>
void WholeBodyCost::forceCost(const Vector3& lambda_C, const Tasks& tasks, double share,
                              CostTerms& terms, InputExpansion* out) const {
  if (!tasks.inContact()) {
    terms.value[kContactForceCost] += 0.5 * share * lambda_C.squaredNorm();
    if constexpr (kExpand) {
      out->gradient.segment<3>(kJointCount) = share * lambda_C;
      out->diagonal.segment<3>(kJointCount).setConstant(share);
      out->force_hessian = share * Matrix3::Identity();
    }
    return;
  }
  const Vector3 error = lambda_C - tasks.contact_force_C;
  terms.value[kContactForceCost] += 0.5 * share * tasks.contact_force_weight.dot(error.cwiseAbs2());
  const double epsilon = constraints_.cone_epsilon, lx = lambda_C.x(), ly = lambda_C.y();
  const double n = std::sqrt(lx * lx + ly * ly + epsilon * epsilon);
  BarrierSum cone(constraints_.cone);
  const auto d = cone.add(constraints_.friction * lambda_C.z() - n, 1, terms);
  terms.value[kFrictionConeCost] += share * cone.value();
  if constexpr (kExpand) {
    const Vector3 h_gradient(-lx / n, -ly / n, constraints_.friction);
    // B' <= 0 and h is concave: both parts of the Hessian are positive semidefinite.
    Matrix3 h_hessian = Matrix3::Zero();
    const double n3 = n * n * n;
    h_hessian(0, 0) = -(ly * ly + epsilon * epsilon) / n3;
    h_hessian(1, 1) = -(lx * lx + epsilon * epsilon) / n3;
    h_hessian(0, 1) = h_hessian(1, 0) = lx * ly / n3;
    const double slope = std::min(0.0, d.first);
    out->gradient.segment<3>(kJointCount) =
        share * (tasks.contact_force_weight.cwiseProduct(error) + d.first * h_gradient);
    out->force_hessian =
        share * (d.second * h_gradient * h_gradient.transpose() + slope * h_hessian);
    out->force_hessian.diagonal() += share * tasks.contact_force_weight;
    out->diagonal.segment<3>(kJointCount) = out->force_hessian.diagonal();
  }
}

void WholeBodyCost::addState(const StateVector& x, const Tasks& tasks, double share,
                             CostTerms& terms) const {
  stateCost<false>(x, dynamics_.endEffector(x), nullptr, tasks, share, terms, nullptr);
}

void WholeBodyCost::expandState(const StateVector& x, const Tasks& tasks, double share,
                                CostTerms& terms, StateExpansion out) const {
  EndEffectorLinearization tip;
  dynamics_.linearizeEndEffector(x, tip);
  expandState(x, tip, tasks, share, terms, out);
}

void WholeBodyCost::expandState(const StateVector& x, const EndEffectorLinearization& tip,
                                const Tasks& tasks, double share, CostTerms& terms,
                                StateExpansion out) const {
  stateCost<true>(x, tip.value, &tip, tasks, share, terms, &out);
}

void WholeBodyCost::addFinal(const StateVector& x, const Tasks& tasks, double share,
                             CostTerms& terms) const {
  CostTerms rate;
  addState(x, tasks, 1, rate);
  for (int i = 0; i < kCostTermCount; ++i) terms.value[i] += share * rate.value[i];
  for (int i = 0; i < kMaxAddedTasks; ++i) terms.added[i] += share * rate.added[i];
  terms.value[kTerminalCost] += terminal_.stateScale() * rate.total();
  if (lqr_value_) terms.value[kTerminalCost] += lqr_value_->value(x, tasks);
  terms.violation = std::max(terms.violation, rate.violation);
}

void WholeBodyCost::expandFinal(const StateVector& x, const Tasks& tasks, double share,
                                CostTerms& terms, ValueFunction<kMpcStateDim>& value) const {
  constexpr int kX = ValueFunction<kMpcStateDim>::kX;
  std::fill(std::begin(value.S_aug), std::end(value.S_aug), 0.0);
  CostTerms rate;
  expandState(x, tasks, 1, rate, {value.S_aug, kX, kMpcStateDim});
  for (double& s : value.S_aug) s *= share + terminal_.stateScale();
  for (int j = 0; j < kX; ++j)
    for (int i = j + 1; i < kX; ++i) value.S_aug[i * kX + j] = value.S_aug[j * kX + i];
  for (int i = 0; i < kCostTermCount; ++i) terms.value[i] += share * rate.value[i];
  for (int i = 0; i < kMaxAddedTasks; ++i) terms.added[i] += share * rate.added[i];
  terms.value[kTerminalCost] += terminal_.stateScale() * rate.total();
  if (lqr_value_) terms.value[kTerminalCost] += lqr_value_->expand(x, tasks, value);
  terms.violation = std::max(terms.violation, rate.violation);
}

void WholeBodyCost::addInput(const JointVector& tau, const ContactInput& contact,
                             const Tasks& tasks, double share, CostTerms& terms) const {
  inputCost<false>(tau, contact, tasks, share, terms, nullptr);
}

void WholeBodyCost::expandInput(const JointVector& tau, const ContactInput& contact,
                                const Tasks& tasks, double share, CostTerms& terms,
                                InputExpansion& out) const {
  inputCost<true>(tau, contact, tasks, share, terms, &out);
}

}  // namespace ballbot
