#include "controller/whole_body_problem.hpp"

#include <algorithm>

#include "controller/euler_rates.hpp"

namespace ballbot {
namespace {

constexpr int kQ = kPositionDim;
constexpr int kV = kVelocityDim;
using Block8 = Eigen::Matrix<double, 8, 8>;

/// M T(q): only the columns of the angular velocity mix.
Block8 timesT(const Block8& M, const EulerRates& euler) {
  Block8 out = M;
  out.middleCols<3>(kOmegaX).noalias() = M.middleCols<3>(kYaw) * euler.T3;
  return out;
}

/// T(q) M, for any number of columns.
template <typename Matrix>
Matrix tTimes(const EulerRates& euler, const Matrix& M) {
  Matrix out = M;
  out.template middleRows<3>(kYaw).noalias() = euler.T3 * M.template middleRows<3>(kOmegaX);
  return out;
}

/// Adds the derivative of a T(q) nu term in q: G (rows of the angles) times the rows of pitch and
/// roll of M.
template <typename Matrix>
void addAngleDerivative(const Eigen::Matrix<double, 3, 2>& G, double factor, const Matrix& M,
                        Matrix& out) {
  out.template middleRows<3>(kYaw).noalias() += factor * G * M.template middleRows<2>(kPitch);
}

}  // namespace

template <int NU>
WholeBodyProblem<NU>::WholeBodyProblem(const RobotParameters& robot, const Constraints& constraints,
                                       const FrequencyShaping& shaping,
                                       const TerminalCost& terminal,
                                       const std::vector<double>& knots)
    : dynamics_(robot),
      cost_(robot, constraints),
      terminal_(terminal),
      state_share_(knots.size(), 0.0),
      tasks_(knots.size()) {
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const double H = knots[k + 1] - knots[k];
    steps_.emplace_back(shaping, H);
    state_share_[k] += 0.5 * H;
    state_share_[k + 1] += 0.5 * H;
  }
}

template <int NU>
void WholeBodyProblem<NU>::setTasks(const TaskSchedule& schedule, double t0,
                                    const ContactSituation& contact) noexcept {
  double t = t0;
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    schedule.at(t, t0, tasks_[k], contact);
    if (k < steps_.size()) t += steps_[k].H;
  }
}

template <int NU>
Vector3 WholeBodyProblem<NU>::forceInContact(const U& u) {
  if constexpr (NU > kJointCount) {
    return u.template segment<3>(kJointCount);
  } else {
    return Vector3::Zero();
  }
}

template <int NU>
Vector3 WholeBodyProblem<NU>::forceInWorld(int k, const U& u) const {
  return tasks_[k].inContact() ? Vector3(tasks_[k].R_WC * forceInContact(u)) : Vector3::Zero();
}

template <int NU>
void WholeBodyProblem<NU>::step(int k, const X& x, const U& u, X& next) const noexcept {
  const double H = steps_[k].H;
  const PositionVector q = x.template head<kQ>();
  const VelocityVector nu = x.template segment<kV>(kQ);
  const PositionVector q_mid = q + 0.5 * H * EulerRates(q).rate(nu);
  const VelocityVector nu_next =
      nu + H * dynamics_.acceleration(q_mid, nu, u.template head<kJointCount>(), forceInWorld(k, u));
  next.template head<kQ>() = q + 0.5 * H * EulerRates(q_mid).rate(nu + nu_next);
  next.template segment<kV>(kQ) = nu_next;
  for (int i = 0; i < kFilterDim; ++i)
    next[kStateDim + i] = steps_[k].next(x[kStateDim + i], u[i]);
}

template <int NU>
void WholeBodyProblem<NU>::linearizeStep(int k, const X& x, const U& u, X& next,
                                         Stage& lq) const noexcept {
  const double H = steps_[k].H;
  const PositionVector q = x.template head<kQ>();
  const VelocityVector nu = x.template segment<kV>(kQ);
  const EulerRates at_start(q);
  const PositionVector q_mid = q + 0.5 * H * at_start.rate(nu);
  StateVector mid;
  mid << q_mid, nu;
  ReducedDynamics::Linearization model;
  dynamics_.linearize(mid, u.template head<kJointCount>(), forceInWorld(k, u), model);
  const VelocityVector nu_next = nu + H * model.f.template tail<kV>();
  const VelocityVector nu_sum = nu + nu_next;
  const EulerRates at_mid(q_mid);
  next.template head<kQ>() = q + 0.5 * H * at_mid.rate(nu_sum);
  next.template segment<kV>(kQ) = nu_next;

  // q_mid = q_mid(q, nu)
  const auto G_start = at_start.derivative(nu);
  Block8 mid_q = Block8::Identity();
  mid_q.block<3, 2>(kYaw, kPitch) += 0.5 * H * G_start;
  const Block8 mid_nu = 0.5 * H * tTimes(at_start, Block8(Block8::Identity()));
  // nu+ = nu + H a(q_mid, nu, u)
  const Block8 a_q = H * model.df_dx.template bottomLeftCorner<kV, kQ>();
  Block8 nu_q = a_q;
  nu_q.middleCols<2>(kPitch).noalias() += 0.5 * H * a_q.middleCols<3>(kYaw) * G_start;
  Block8 nu_nu = H * model.df_dx.template bottomRightCorner<kV, kV>() +
                 0.5 * H * timesT(a_q, at_start);
  nu_nu.diagonal().array() += 1;
  // q+ = q + H/2 T(q_mid) (nu + nu+)
  const auto G_mid = at_mid.derivative(nu_sum);
  Block8 q_q = 0.5 * H * tTimes(at_mid, nu_q);
  addAngleDerivative(G_mid, 0.5 * H, mid_q, q_q);
  q_q.diagonal().array() += 1;
  Block8 two_nu = nu_nu;
  two_nu.diagonal().array() += 1;
  Block8 q_nu = 0.5 * H * tTimes(at_mid, two_nu);
  addAngleDerivative(G_mid, 0.5 * H, mid_nu, q_nu);

  auto A = lq.A();
  A.template block<8, 8>(0, 0) = q_q;
  A.template block<8, 8>(0, kQ) = q_nu;
  A.template block<8, 8>(kQ, 0) = nu_q;
  A.template block<8, 8>(kQ, kQ) = nu_nu;

  Eigen::Matrix<double, kV, NU> nu_u;
  nu_u.template leftCols<kJointCount>() = H * model.df_dtau.template bottomRows<kV>();
  if constexpr (NU > kJointCount) {
    if (tasks_[k].inContact()) {
      nu_u.template rightCols<3>().noalias() =
          H * model.df_dlambda.template bottomRows<kV>() * tasks_[k].R_WC;
    } else {
      nu_u.template rightCols<3>().setZero();
    }
  }
  auto B = lq.B();
  B.template block<8, NU>(0, 0) = 0.5 * H * tTimes(at_mid, nu_u);
  B.template block<8, NU>(kQ, 0) = nu_u;

  for (int i = 0; i < kFilterDim; ++i) {
    const FilterStep& filter = steps_[k];
    next[kStateDim + i] = filter.next(x[kStateDim + i], u[i]);
    A(kStateDim + i, kStateDim + i) = filter.a;
    B(kStateDim + i, i) = 1 - filter.a;
  }
}

template <int NU>
void WholeBodyProblem<NU>::addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept {
  const Tasks& tasks = tasks_[k];
  const FilterStep& filter = steps_[k];
  cost_.addState(x.template head<kStateDim>(), tasks, state_share_[k], terms);
  cost_.addInput(u.template head<kJointCount>(), forceInContact(u), tasks, filter.H, terms);
  for (int i = 0; i < kFilterDim; ++i) {
    terms.value[kWheelTorqueCost] +=
        0.5 * tasks.wheel_torque_weight * filter.cost(x[kStateDim + i], u[i]);
  }
}

template <int NU>
void WholeBodyProblem<NU>::approximateCost(int k, const X& x, const U& u, CostTerms& terms,
                                           Stage& lq) const noexcept {
  const Tasks& tasks = tasks_[k];
  const FilterStep& f = steps_[k];
  std::fill(std::begin(lq.Wxx), std::end(lq.Wxx), 0.0);
  cost_.expandState(x.template head<kStateDim>(), tasks, state_share_[k], terms,
                    {lq.Wxx, Stage::kX, kMpcStateDim});
  InputExpansion input;
  cost_.expandInput(u.template head<kJointCount>(), forceInContact(u), tasks, f.H, terms, input);

  auto R = lq.R();
  auto r = lq.r();
  R.diagonal() = input.diagonal.template head<NU>();
  r = input.gradient.template head<NU>();
  if constexpr (NU > kJointCount) R.template bottomRightCorner<3, 3>() = input.force_hessian;

  // 1/2 w (H u^2 + 2 c1 u d + c2 d^2), d = u - x_f
  auto Q = lq.Q();
  auto q = lq.q();
  auto Pt = lq.Pt();
  const double w = tasks.wheel_torque_weight;
  for (int i = 0; i < kFilterDim; ++i) {
    const int at = kStateDim + i;
    const double d = u[i] - x[at];
    terms.value[kWheelTorqueCost] += 0.5 * w * f.cost(x[at], u[i]);
    R(i, i) += w * (f.H + 2 * f.c1 + f.c2);
    r[i] += w * (f.H * u[i] + f.c1 * (u[i] + d) + f.c2 * d);
    Q(at, at) += w * f.c2;
    q[at] += -w * (f.c1 * u[i] + f.c2 * d);
    Pt(at, i) = -w * (f.c1 + f.c2);
  }
}

template <int NU>
void WholeBodyProblem<NU>::addFinalCost(const X& x, CostTerms& terms) const noexcept {
  cost_.addFinal(x.template head<kStateDim>(), tasks_.back(), state_share_.back(),
                 terminal_.state_scale, terms);
}

template <int NU>
void WholeBodyProblem<NU>::approximateFinalCost(const X& x, CostTerms& terms,
                                                ValueFunction<kMpcStateDim>& value) const noexcept {
  cost_.expandFinal(x.template head<kStateDim>(), tasks_.back(), state_share_.back(),
                    terminal_.state_scale, terms, value);
}

template class WholeBodyProblem<6>;
template class WholeBodyProblem<9>;

}  // namespace ballbot
