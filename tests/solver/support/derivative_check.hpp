#pragma once

#include <gtest/gtest.h>

#include "solver/optimal_control_problem.hpp"

namespace ballbot {

enum class Hessian { kExact, kOfInputsOnly };  ///< what of it: Gauss-Newton leaves parts out

/// All that approximate() says of one stage, against central differences of step() and addCost()
/// and, for second derivatives, of its own gradients. Needs a cost whose expansion is exact.
/// @param tolerance  absolute, of each element
template <int NX, int NU, typename Cost>
void expectDerivativesOf(const OptimalControlProblem<NX, NU, Cost>& problem,
                         const Eigen::Matrix<double, NX, 1>& x,
                         const Eigen::Matrix<double, NU, 1>& u, double tolerance,
                         Hessian exact = Hessian::kExact) {
  using X = Eigen::Matrix<double, NX, 1>;
  using U = Eigen::Matrix<double, NU, 1>;
  using Z = Eigen::Matrix<double, NX + NU, 1>;
  constexpr double kStep = 1e-5;
  const auto approximated = [&](const Z& z) {
    const X xz = z.template head<NX>();
    const U uz = z.template tail<NU>();
    LqStage<NX, NU> lq;
    Cost cost;
    problem.approximate(0, 1, &xz, &uz, &cost, &lq);
    return lq;
  };
  const auto gradient = [&](const Z& z) {
    LqStage<NX, NU> lq = approximated(z);
    Z out;
    out << X(lq.q()), U(lq.r());
    return out;
  };
  const auto next = [&](const Z& z) {
    X out;
    problem.step(0, z.template head<NX>(), z.template tail<NU>(), out);
    return out;
  };
  const auto cost = [&](const Z& z) {
    Cost out;
    problem.addCost(0, z.template head<NX>(), z.template tail<NU>(), out);
    return out.total();
  };
  Z z;
  z << x, u;
  LqStage<NX, NU> lq = approximated(z);
  Eigen::Matrix<double, NX, NX + NU> AB;
  AB << Eigen::Matrix<double, NX, NX>(lq.A()), Eigen::Matrix<double, NX, NU>(lq.B());
  Eigen::Matrix<double, NX + NU, NX + NU> hessian;
  const Eigen::Matrix<double, NX, NU> Pt = lq.Pt();
  hessian << Eigen::Matrix<double, NX, NX>(lq.Q()), Pt, Pt.transpose(),
      Eigen::Matrix<double, NU, NU>(lq.R());
  for (int i = 0; i < NX + NU; ++i) {
    const Z d = kStep * Z::Unit(i);
    EXPECT_LT((AB.col(i) - (next(z + d) - next(z - d)) / (2 * kStep)).cwiseAbs().maxCoeff(),
              tolerance)
        << "dynamics, element " << i;
    EXPECT_NEAR(gradient(z)[i], (cost(z + d) - cost(z - d)) / (2 * kStep), tolerance)
        << "gradient, element " << i;
    if (exact == Hessian::kOfInputsOnly && i < NX) continue;
    EXPECT_LT(
        (hessian.col(i) - (gradient(z + d) - gradient(z - d)) / (2 * kStep)).cwiseAbs().maxCoeff(),
        tolerance)
        << "Hessian, element " << i;
  }
}

}  // namespace ballbot
