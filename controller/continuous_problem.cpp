#include "controller/continuous_problem.hpp"

#include <algorithm>

namespace ballbot {
namespace {

template <typename U>
Vector3 forceInContact(const U& u) {
  if constexpr (U::RowsAtCompileTime > kJointCount) {
    return u.template segment<3>(kJointCount);
  } else {
    return Vector3::Zero();
  }
}

template <typename U>
Vector3 forceInWorld(const U& u, const Tasks& tasks) {
  return tasks.inContact() ? Vector3(tasks.R_WC * forceInContact(u)) : Vector3::Zero();
}

}  // namespace

template <int NU>
ContinuousProblem<NU>::ContinuousProblem(const RobotParameters& robot,
                                         const Constraints& constraints,
                                         const FrequencyShaping& shaping,
                                         const TerminalCost& terminal)
    : dynamics_(robot), cost_(robot, constraints), shaping_(shaping), terminal_(terminal) {}

template <int NU>
void ContinuousProblem<NU>::flow(const X& x, const U& u, const Tasks& tasks,
                                 X& dx) const noexcept {
  dx.template head<kStateDim>() = dynamics_.derivative(
      x.template head<kStateDim>(), u.template head<kJointCount>(), forceInWorld(u, tasks));
  dx.template tail<kFilterDim>() =
      shaping_.pole * (u.template head<kFilterDim>() - x.template tail<kFilterDim>());
}

template <int NU>
void ContinuousProblem<NU>::addCostRate(const X& x, const U& u, const Tasks& tasks,
                                        CostTerms& terms) const noexcept {
  cost_.addState(x.template head<kStateDim>(), tasks, 1, terms);
  cost_.addInput(u.template head<kJointCount>(), forceInContact(u), tasks, 1, terms);
  const double rho = shaping_.rho();
  const Vector3 shaped =
      rho * u.template head<kFilterDim>() - (rho - 1) * x.template tail<kFilterDim>();
  terms.value[kWheelTorqueCost] += 0.5 * tasks.wheel_torque_weight * shaped.squaredNorm();
}

template <int NU>
void ContinuousProblem<NU>::expand(const X& x, const U& u, const Tasks& tasks, X& dx,
                                   Expansion& out) const noexcept {
  ReducedDynamics::Linearization model;
  dynamics_.linearize(x.template head<kStateDim>(), u.template head<kJointCount>(),
                      forceInWorld(u, tasks), model);
  dx.template head<kStateDim>() = model.f;
  dx.template tail<kFilterDim>() =
      shaping_.pole * (u.template head<kFilterDim>() - x.template tail<kFilterDim>());
  auto A = out.A();
  auto B = out.B();
  A.template topLeftCorner<kStateDim, kStateDim>() = model.df_dx;
  B.template topLeftCorner<kStateDim, kJointCount>() = model.df_dtau;
  if constexpr (NU > kJointCount) {
    if (tasks.inContact()) {
      B.template topRightCorner<kStateDim, 3>() = model.df_dlambda * tasks.R_WC;
    } else {
      B.template topRightCorner<kStateDim, 3>().setZero();
    }
  }

  std::fill(std::begin(out.Wxx), std::end(out.Wxx), 0.0);
  CostTerms unused;
  cost_.expandState(x.template head<kStateDim>(), tasks, 1, unused,
                    {out.Wxx, Expansion::kX, kMpcStateDim});
  InputExpansion input;
  cost_.expandInput(u.template head<kJointCount>(), forceInContact(u), tasks, 1, unused, input);
  auto R = out.R();
  auto r = out.r();
  R.setZero();
  R.diagonal() = input.diagonal.template head<NU>();
  r = input.gradient.template head<NU>();
  if constexpr (NU > kJointCount) R.template bottomRightCorner<3, 3>() = input.force_hessian;

  // 1/2 w (rho u - (rho - 1) x_f)^2
  auto Q = out.Q();
  auto q = out.q();
  auto Pt = out.Pt();
  const double w = tasks.wheel_torque_weight, rho = shaping_.rho();
  for (int i = 0; i < kFilterDim; ++i) {
    const int at = kStateDim + i;
    const double shaped = rho * u[i] - (rho - 1) * x[at];
    A(at, at) = -shaping_.pole;
    B(at, i) = shaping_.pole;
    R(i, i) += w * rho * rho;
    r[i] += w * rho * shaped;
    Q(at, at) += w * (rho - 1) * (rho - 1);
    q[at] -= w * (rho - 1) * shaped;
    Pt(at, i) = -w * rho * (rho - 1);
  }
}

template <int NU>
void ContinuousProblem<NU>::addFinalCost(const X& x, const Tasks& tasks,
                                         CostTerms& terms) const noexcept {
  cost_.addFinal(x.template head<kStateDim>(), tasks, 0, terminal_.state_scale, terms);
}

template <int NU>
void ContinuousProblem<NU>::expandFinalCost(const X& x, const Tasks& tasks,
                                            ValueFunction<kMpcStateDim>& value) const noexcept {
  CostTerms unused;
  cost_.expandFinal(x.template head<kStateDim>(), tasks, 0, terminal_.state_scale, unused, value);
}

template class ContinuousProblem<6>;
template class ContinuousProblem<9>;

}  // namespace ballbot
