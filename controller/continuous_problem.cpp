#include "controller/continuous_problem.hpp"

#include <algorithm>

#include "controller/contact_input.hpp"

namespace ballbot {

template <int NU>
ContinuousProblem<NU>::ContinuousProblem(const RobotParameters& robot,
                                         const Constraints& constraints,
                                         const FrequencyShaping& shaping,
                                         const TerminalCost& terminal)
    : dynamics_(robot), cost_(robot, constraints, terminal), shaping_(shaping) {}

template <int NU>
void ContinuousProblem<NU>::flow(const X& x, const U& u, const Tasks& tasks,
                                 X& dx) const noexcept {
  const ContactWrench wrench(u, tasks);
  dx.template head<kStateDim>() = dynamics_.derivative(
      x.template head<kStateDim>(), u.template head<kJointCount>(), wrench.force,
      NU > kJointCount + 3 ? &wrench.moment : nullptr);
  dx.template tail<kFilterDim>() =
      shaping_.pole * (u.template head<kFilterDim>() - x.template tail<kFilterDim>());
}

template <int NU>
void ContinuousProblem<NU>::addCostRate(const X& x, const U& u, const Tasks& tasks,
                                        CostTerms& terms) const noexcept {
  cost_.addState(x.template head<kStateDim>(), tasks, 1, terms);
  cost_.addInput(u.template head<kJointCount>(), contactInput(u), tasks, 1, terms);
  const double rho = shaping_.rho();
  const Vector3 shaped =
      rho * u.template head<kFilterDim>() - (rho - 1) * x.template tail<kFilterDim>();
  terms.value[kWheelTorqueCost] += 0.5 * tasks.wheel_torque_weight * shaped.squaredNorm();
}

template <int NU>
void ContinuousProblem<NU>::expand(const X& x, const U& u, const Tasks& tasks, X& dx,
                                   Expansion& out) const noexcept {
  ReducedDynamics::Linearization model;
  const ContactWrench wrench(u, tasks);
  dynamics_.linearize(x.template head<kStateDim>(), u.template head<kJointCount>(), wrench.force,
                      model, NU > kJointCount + 3 ? &wrench.moment : nullptr);
  dx.template head<kStateDim>() = model.f;
  dx.template tail<kFilterDim>() =
      shaping_.pole * (u.template head<kFilterDim>() - x.template tail<kFilterDim>());
  auto A = out.A();
  auto B = out.B();
  A.template topLeftCorner<kStateDim, kStateDim>() = model.df_dx;
  B.template topLeftCorner<kStateDim, kJointCount>() = model.df_dtau;
  setContactColumns<NU - kJointCount>(tasks, model.df_dlambda, model.df_dmoment,
                                      B.template topRightCorner<kStateDim, NU - kJointCount>());

  std::fill(std::begin(out.Wxx), std::end(out.Wxx), 0.0);
  CostTerms unused;
  cost_.expandState(x.template head<kStateDim>(), tasks, 1, unused,
                    {out.Wxx, Expansion::kX, kMpcStateDim});
  InputExpansion input;
  cost_.expandInput(u.template head<kJointCount>(), contactInput(u), tasks, 1, unused, input);
  auto R = out.R();
  auto r = out.r();
  setInputExpansion<NU>(input, R, r);

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
  cost_.addFinal(x.template head<kStateDim>(), tasks, 0, terms);
}

template <int NU>
void ContinuousProblem<NU>::expandFinalCost(const X& x, const Tasks& tasks,
                                            ValueFunction<kMpcStateDim>& value) const noexcept {
  CostTerms unused;
  cost_.expandFinal(x.template head<kStateDim>(), tasks, 0, unused, value);
}

template class ContinuousProblem<6>;
template class ContinuousProblem<9>;
template class ContinuousProblem<12>;

}  // namespace ballbot
