#pragma once

#include <cstdlib>

#include "solver/optimal_control_problem.hpp"
#include "solver/scalar_cost.hpp"

namespace ballbot {

/// Linear dynamics and quadratic cost with cross and linear terms, the same at every stage: the
/// case with a textbook solution.
template <int NX, int NU>
class LinearQuadraticProblem final : public OptimalControlProblem<NX, NU, ScalarCost> {
 public:
  using Base = OptimalControlProblem<NX, NU, ScalarCost>;
  using X = typename Base::X;
  using U = typename Base::U;
  using MatrixX = Eigen::Matrix<double, NX, NX>;
  using MatrixU = Eigen::Matrix<double, NU, NU>;
  using MatrixXU = Eigen::Matrix<double, NX, NU>;

  LinearQuadraticProblem(int stages, unsigned seed) : stages_(stages) {
    std::srand(seed);
    A = MatrixX::Identity() + 0.1 * MatrixX::Random();
    B = 0.3 * MatrixXU::Random();
    const Eigen::MatrixXd half = Eigen::MatrixXd::Random(NX + NU, NX + NU);
    const Eigen::MatrixXd W = half * half.transpose();
    Q = W.topLeftCorner(NX, NX);
    R = W.bottomRightCorner(NU, NU) + MatrixU::Identity();
    Pt = W.topRightCorner(NX, NU);
    q.setRandom();
    r.setRandom();
    Qf = MatrixX::Identity();
  }

  int stages() const noexcept override { return stages_; }
  void step(int, const X& x, const U& u, X& next) const noexcept override {
    next.noalias() = A * x + B * u;
  }
  void addCost(int, const X& x, const U& u, ScalarCost& cost) const noexcept override {
    cost.add(0.5 * x.dot(Q * x) + x.dot(Pt * u) + 0.5 * u.dot(R * u) + q.dot(x) + r.dot(u));
  }
  void addFinalCost(const X& x, ScalarCost& cost) const noexcept override {
    cost.add(0.5 * x.dot(Qf * x));
  }
  void approximate(int first, int count, const X* x, const U* u, ScalarCost* cost,
                   LqStage<NX, NU>* lq) const noexcept override {
    for (int i = 0; i < count; ++i) {
      addCost(first + i, x[i], u[i], cost[i]);
      lq[i].A() = A;
      lq[i].B() = B;
      lq[i].Q() = Q;
      lq[i].R() = R;
      lq[i].Pt() = Pt;
      lq[i].q() = Q * x[i] + Pt * u[i] + q;
      lq[i].r() = R * u[i] + Pt.transpose() * x[i] + r;
    }
  }
  void approximateFinalCost(const X& x, ScalarCost& cost,
                            ValueFunction<NX>& value) const noexcept override {
    addFinalCost(x, cost);
    value.set(Qf, Qf * x, 0);
  }

  MatrixX A, Q, Qf;
  MatrixXU B, Pt;
  MatrixU R;
  X q;
  U r;

 private:
  int stages_;
};

}  // namespace ballbot
