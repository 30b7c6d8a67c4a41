#include "controller/whole_body_problem.hpp"

#include <algorithm>

#include "controller/contact_input.hpp"
#include "controller/euler_rates.hpp"
#include "controller/input_sizes.hpp"
#include "solver/shaped_input.hpp"

namespace ballbot {
namespace {

constexpr int kQ = kPositionDim;
constexpr int kV = kVelocityDim;
static_assert(kQ == kV);
using Block = Eigen::Matrix<double, kV, kV>;

/// M T(q): only the columns of the angular velocity mix.
Block timesT(const Block& M, const EulerRates& euler) {
  Block out = M;
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
      cost_(robot, constraints, terminal),
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
                                    const ContactSituation& contact,
                                    const GovernedCommands& commands) noexcept {
  double t = t0;
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    schedule.at(t, t0, tasks_[k], contact, commands);
    if (k < steps_.size()) t += steps_[k].H;
  }
}

template <int NU>
void WholeBodyProblem<NU>::step(int k, const X& x, const U& u, X& next) const noexcept {
  const double H = steps_[k].H;
  const PositionVector q = x.template head<kQ>();
  const VelocityVector nu = x.template segment<kV>(kQ);
  StateVector mid;
  mid << q + 0.5 * H * EulerRates(q).rate(nu), nu;
  const ContactWrench wrench(u, tasks_[k]);
  const VelocityVector nu_next =
      nu + H * dynamics_
                   .derivative(mid, u.template head<kJointCount>(), wrench.force,
                               NU > kJointCount + 3 ? &wrench.moment : nullptr)
                   .template tail<kV>();
  next.template head<kQ>() = q + 0.5 * H * EulerRates(mid.template head<kQ>()).rate(nu + nu_next);
  next.template segment<kV>(kQ) = nu_next;
  for (int i = 0; i < kFilterDim; ++i) next[kStateDim + i] = steps_[k].next(x[kStateDim + i], u[i]);
}

template <int NU>
void WholeBodyProblem<NU>::linearize(int first, int count, const X* x, const U* u,
                                     Stage* lq) const noexcept {
  StateVector mid[kTogether];
  JointVector tau[kTogether];
  Vector3 force[kTogether], moment[kTogether];
  ReducedDynamics::Linearization model[kTogether];
  for (int i = 0; i < count; ++i) {
    const PositionVector q = x[i].template head<kQ>();
    const VelocityVector nu = x[i].template segment<kV>(kQ);
    mid[i] << q + 0.5 * steps_[first + i].H * EulerRates(q).rate(nu), nu;
    tau[i] = u[i].template head<kJointCount>();
    const ContactWrench wrench(u[i], tasks_[first + i]);
    force[i] = wrench.force;
    moment[i] = wrench.moment;
  }
  dynamics_.linearize(count, mid, tau, force, model, nullptr,
                      NU > kJointCount + 3 ? moment : nullptr);
  for (int i = 0; i < count; ++i) {
    linearizeStage(first + i, x[i], mid[i].template head<kQ>(), model[i], lq[i]);
  }
}

template <int NU>
void WholeBodyProblem<NU>::linearizeStage(int k, const X& x, const PositionVector& q_mid,
                                          const ReducedDynamics::Linearization& model,
                                          Stage& lq) const noexcept {
  const double H = steps_[k].H;
  const VelocityVector nu = x.template segment<kV>(kQ);
  const EulerRates at_start(x.template head<kQ>()), at_mid(q_mid);
  const VelocityVector nu_sum = 2 * nu + H * model.f.template tail<kV>();  // nu + nu+

  // q_mid = q_mid(q, nu)
  const auto G_start = at_start.derivative(nu);
  Block mid_q = Block::Identity();
  mid_q.block<3, 2>(kYaw, kPitch) += 0.5 * H * G_start;
  const Block mid_nu = 0.5 * H * tTimes(at_start, Block(Block::Identity()));
  // nu+ = nu + H a(q_mid, nu, u)
  const Block a_q = H * model.df_dx.template bottomLeftCorner<kV, kQ>();
  Block nu_q = a_q;
  nu_q.middleCols<2>(kPitch).noalias() += 0.5 * H * a_q.middleCols<3>(kYaw) * G_start;
  Block nu_nu =
      H * model.df_dx.template bottomRightCorner<kV, kV>() + 0.5 * H * timesT(a_q, at_start);
  nu_nu.diagonal().array() += 1;
  // q+ = q + H/2 T(q_mid) (nu + nu+)
  const auto G_mid = at_mid.derivative(nu_sum);
  Block q_q = 0.5 * H * tTimes(at_mid, nu_q);
  addAngleDerivative(G_mid, 0.5 * H, mid_q, q_q);
  q_q.diagonal().array() += 1;
  Block two_nu = nu_nu;
  two_nu.diagonal().array() += 1;
  Block q_nu = 0.5 * H * tTimes(at_mid, two_nu);
  addAngleDerivative(G_mid, 0.5 * H, mid_nu, q_nu);

  auto A = lq.A();
  A.template block<kV, kV>(0, 0) = q_q;
  A.template block<kV, kV>(0, kQ) = q_nu;
  A.template block<kV, kV>(kQ, 0) = nu_q;
  A.template block<kV, kV>(kQ, kQ) = nu_nu;

  Eigen::Matrix<double, kV, NU> nu_u;
  nu_u.template leftCols<kJointCount>() = model.df_dtau.template bottomRows<kV>();
  setContactColumns<NU - kJointCount>(tasks_[k], model.df_dlambda.template bottomRows<kV>(),
                                      model.df_dmoment.template bottomRows<kV>(),
                                      nu_u.template rightCols<NU - kJointCount>());
  nu_u *= H;
  auto B = lq.B();
  B.template block<kV, NU>(0, 0) = 0.5 * H * tTimes(at_mid, nu_u);
  B.template block<kV, NU>(kQ, 0) = nu_u;

  for (int i = 0; i < kFilterDim; ++i) linearizeFilter(steps_[k], kStateDim + i, i, lq);
}

template <int NU>
void WholeBodyProblem<NU>::addCost(int k, const X& x, const U& u, CostTerms& terms) const noexcept {
  const Tasks& tasks = tasks_[k];
  const FilterStep& filter = steps_[k];
  cost_.addState(x.template head<kStateDim>(), tasks, state_share_[k], terms);
  cost_.addInput(u.template head<kJointCount>(), contactInput(u), tasks, filter.H, terms);
  for (int i = 0; i < kFilterDim; ++i) {
    terms.value[kWheelTorqueCost] +=
        0.5 * tasks.wheel_torque_weight * filter.cost(x[kStateDim + i], u[i]);
  }
}

template <int NU>
void WholeBodyProblem<NU>::approximate(int first, int count, const X* x, const U* u,
                                       CostTerms* terms, Stage* lq) const noexcept {
  ReducedDynamics::EndEffectorLinearization tip[kTogether];
  StateVector robot[kTogether];
  for (int i = 0; i < count; i += kTogether) {
    const int now = std::min(kTogether, count - i);
    linearize(first + i, now, x + i, u + i, lq + i);
    for (int j = 0; j < now; ++j) robot[j] = x[i + j].template head<kStateDim>();
    dynamics_.linearizeEndEffector(now, robot, tip);
    for (int j = 0; j < now; ++j) {
      approximateCost(first + i + j, x[i + j], u[i + j], tip[j], terms[i + j], lq[i + j]);
    }
  }
}

template <int NU>
void WholeBodyProblem<NU>::approximateCost(int k, const X& x, const U& u,
                                           const ReducedDynamics::EndEffectorLinearization& tip,
                                           CostTerms& terms, Stage& lq) const noexcept {
  const Tasks& tasks = tasks_[k];
  const FilterStep& f = steps_[k];
  std::fill(std::begin(lq.Wxx), std::end(lq.Wxx), 0.0);
  cost_.expandState(x.template head<kStateDim>(), tip, tasks, state_share_[k], terms,
                    {lq.Wxx, Stage::kX, kMpcStateDim});
  InputExpansion input;
  cost_.expandInput(u.template head<kJointCount>(), contactInput(u), tasks, f.H, terms, input);
  auto R = lq.R();
  auto r = lq.r();
  setInputExpansion<NU>(input, R, r);

  const double w = tasks.wheel_torque_weight;
  for (int i = 0; i < kFilterDim; ++i) {
    const int at = kStateDim + i;
    terms.value[kWheelTorqueCost] += 0.5 * w * f.cost(x[at], u[i]);
    expandShapedCost(f, w, at, i, x[at], u[i], lq);
  }
}

template <int NU>
void WholeBodyProblem<NU>::addFinalCost(const X& x, CostTerms& terms) const noexcept {
  cost_.addFinal(x.template head<kStateDim>(), tasks_.back(), state_share_.back(), terms);
}

template <int NU>
void WholeBodyProblem<NU>::approximateFinalCost(const X& x, CostTerms& terms,
                                                ValueFunction<kMpcStateDim>& value) const noexcept {
  cost_.expandFinal(x.template head<kStateDim>(), tasks_.back(), state_share_.back(), terms, value);
}

#define BALLBOT_INSTANTIATE(NU) template class WholeBodyProblem<NU>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
