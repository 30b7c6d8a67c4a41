#pragma once

#include "solver/optimal_control_problem.hpp"
#include "solver/scalar_cost.hpp"

namespace ballbot {

/// A model of dx/dt = f(x, u) with a cost rate, on a grid of equal steps with held inputs: dynamics
/// by the classical Runge-Kutta method and their derivatives by the chain rule through its stages,
/// costs by the left-hand rectangle rule. The model has kNX, kNU and, all const:
///
///   flow(x, u)                 f
///   linearize(x, u, fx, fu)    overwrites its Jacobians
///   addCost(x, u, dt, cost)    and, adding to the expansion of a stage that is zero,
///   expandCost(x, u, dt, lq)
///   addFinalCost(x, cost), expandFinalCost(x, value)
template <typename Model>
class DiscretisedProblem final : public OptimalControlProblem<Model::kNX, Model::kNU, ScalarCost> {
 public:
  static constexpr int NX = Model::kNX, NU = Model::kNU;
  using Base = OptimalControlProblem<NX, NU, ScalarCost>;
  using X = typename Base::X;
  using U = typename Base::U;
  using MatrixX = Eigen::Matrix<double, NX, NX>;
  using MatrixXU = Eigen::Matrix<double, NX, NU>;

  /// @param step  [s]
  DiscretisedProblem(const Model& model, int stages, double step)
      : model_(model), stages_(stages), h_(step) {}

  const Model& model() const { return model_; }
  double stepLength() const { return h_; }

  int stages() const noexcept override { return stages_; }
  void step(int, const X& x, const U& u, X& next) const noexcept override {
    const X k1 = model_.flow(x, u);
    const X k2 = model_.flow(x + h_ / 2 * k1, u);
    const X k3 = model_.flow(x + h_ / 2 * k2, u);
    const X k4 = model_.flow(x + h_ * k3, u);
    next = x + h_ / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  void addCost(int, const X& x, const U& u, ScalarCost& cost) const noexcept override {
    model_.addCost(x, u, h_, cost);
  }
  void addFinalCost(const X& x, ScalarCost& cost) const noexcept override {
    model_.addFinalCost(x, cost);
  }
  void approximate(int first, int count, const X* x, const U* u, ScalarCost* cost,
                   LqStage<NX, NU>* lq) const noexcept override {
    for (int i = 0; i < count; ++i) {
      addCost(first + i, x[i], u[i], cost[i]);
      linearize(x[i], u[i], lq[i]);
      lq[i].Q().setZero();
      lq[i].q().setZero();
      lq[i].R().setZero();
      lq[i].r().setZero();
      model_.expandCost(x[i], u[i], h_, lq[i]);
    }
  }
  void approximateFinalCost(const X& x, ScalarCost& cost,
                            ValueFunction<NX>& value) const noexcept override {
    addFinalCost(x, cost);
    model_.expandFinalCost(x, value);
  }

 private:
  void linearize(const X& x, const U& u, LqStage<NX, NU>& lq) const noexcept {
    MatrixX fx, kx = MatrixX::Zero(), sum_x = MatrixX::Zero();  // of k_i in x
    MatrixXU fu, ku = MatrixXU::Zero(), sum_u = MatrixXU::Zero();
    X k = X::Zero();
    const double reach[4] = {0, h_ / 2, h_ / 2, h_}, weight[4] = {1, 2, 2, 1};
    for (int i = 0; i < 4; ++i) {
      const X at = x + reach[i] * k;
      model_.linearize(at, u, fx, fu);
      k = model_.flow(at, u);
      ku = (fx * (reach[i] * ku) + fu).eval();
      kx = (fx + reach[i] * fx * kx).eval();
      sum_x += weight[i] * kx;
      sum_u += weight[i] * ku;
    }
    lq.A() = MatrixX::Identity() + h_ / 6 * sum_x;
    lq.B() = h_ / 6 * sum_u;
  }

  Model model_;
  int stages_;
  double h_;
};

}  // namespace ballbot
