#include "controller/continuous_problem.hpp"

#include <algorithm>

#include "controller/contact_input.hpp"
#include "controller/input_sizes.hpp"
#include "solver/shaped_input.hpp"

namespace ballbot {

template <int NU>
ContinuousProblem<NU>::ContinuousProblem(const RobotParameters& robot,
                                         const Constraints& constraints,
                                         const FrequencyShaping& shaping,
                                         const TerminalCost& terminal,
                                         std::shared_ptr<const TaskSchedule> schedule)
    : dynamics_(robot),
      cost_(robot, constraints, terminal),
      shaping_(shaping),
      schedule_(std::move(schedule)) {}

template <int NU>
void ContinuousProblem<NU>::setHorizon(double t0, const ContactSituation& contact,
                                       const GovernedCommands& commands) noexcept {
  t0_ = t0;
  contact_ = contact;
  commands_ = commands;
}

template <int NU>
void ContinuousProblem<NU>::setTime(double t) noexcept {
  schedule_->at(t0_ + t, t0_, tasks_, contact_, commands_);
}

template <int NU>
void ContinuousProblem<NU>::flow(const X& x, const U& u, X& dx) const noexcept {
  const ContactWrench wrench(u, tasks_);
  dx.template head<kStateDim>() =
      dynamics_.derivative(x.template head<kStateDim>(), u.template head<kJointCount>(),
                           wrench.force, NU > kJointCount + 3 ? &wrench.moment : nullptr);
  dx.template tail<kFilterDim>() =
      shaping_.pole * (u.template head<kFilterDim>() - x.template tail<kFilterDim>());
}

template <int NU>
void ContinuousProblem<NU>::addCostRate(const X& x, const U& u, CostTerms& terms) const noexcept {
  cost_.addState(x.template head<kStateDim>(), tasks_, 1, terms);
  cost_.addInput(u.template head<kJointCount>(), contactInput(u), tasks_, 1, terms);
  const double rho = shaping_.rho();
  const Vector3 shaped =
      rho * u.template head<kFilterDim>() - (rho - 1) * x.template tail<kFilterDim>();
  terms.value[kWheelTorqueCost] += 0.5 * tasks_.wheel_torque_weight * shaped.squaredNorm();
}

template <int NU>
void ContinuousProblem<NU>::expand(const X& x, const U& u, X& dx, Expansion& out) const noexcept {
  ReducedDynamics::Linearization model;
  const ContactWrench wrench(u, tasks_);
  dynamics_.linearize(x.template head<kStateDim>(), u.template head<kJointCount>(), wrench.force,
                      model, NU > kJointCount + 3 ? &wrench.moment : nullptr);
  dx.template head<kStateDim>() = model.f;
  dx.template tail<kFilterDim>() =
      shaping_.pole * (u.template head<kFilterDim>() - x.template tail<kFilterDim>());
  auto A = out.A();
  auto B = out.B();
  A.template topLeftCorner<kStateDim, kStateDim>() = model.df_dx;
  B.template topLeftCorner<kStateDim, kJointCount>() = model.df_dtau;
  setContactColumns<NU - kJointCount>(tasks_, model.df_dlambda, model.df_dmoment,
                                      B.template topRightCorner<kStateDim, NU - kJointCount>());

  std::fill(std::begin(out.Wxx), std::end(out.Wxx), 0.0);
  CostTerms unused;
  cost_.expandState(x.template head<kStateDim>(), tasks_, 1, unused,
                    {out.Wxx, Expansion::kX, kMpcStateDim});
  InputExpansion input;
  cost_.expandInput(u.template head<kJointCount>(), contactInput(u), tasks_, 1, unused, input);
  auto R = out.R();
  auto r = out.r();
  setInputExpansion<NU>(input, R, r);

  for (int i = 0; i < kFilterDim; ++i) {
    const int at = kStateDim + i;
    expandShapedRate(shaping_, tasks_.wheel_torque_weight, at, i, x[at], u[i], out);
  }
}

template <int NU>
void ContinuousProblem<NU>::addFinalCost(const X& x, CostTerms& terms) const noexcept {
  cost_.addFinal(x.template head<kStateDim>(), tasks_, 0, terms);
}

template <int NU>
void ContinuousProblem<NU>::expandFinalCost(const X& x,
                                            ValueFunction<kMpcStateDim>& value) const noexcept {
  CostTerms unused;
  cost_.expandFinal(x.template head<kStateDim>(), tasks_, 0, unused, value);
}

#define BALLBOT_INSTANTIATE(NU) template class ContinuousProblem<NU>;
BALLBOT_FOR_INPUT_SIZES(BALLBOT_INSTANTIATE)
#undef BALLBOT_INSTANTIATE

}  // namespace ballbot
