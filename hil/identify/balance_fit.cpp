#include "hil/identify/balance_fit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr int kIterations = 60, kWeighings = 3, kFewestEquations = 40;
constexpr double kBlock_s = 0.1;  // longer than any memory of a residual
// Where the search begins: within a factor of ten of what a joint of some Nm has.
const BalanceVector kStart = (BalanceVector() << 0.05, 200, 0.1, 0.1, 0.1, 0.01, 0.0).finished();

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// Least squares of all records around one point: A step = g.
struct Normal {
  Matrix A;
  Vector g;
  double cost = 0;
};

struct Unknowns {
  BalanceVector p;
  std::vector<double> zeros;
};

int sizeOf(const std::vector<MomentumBalance>& balances) {
  return kBalanceCount + static_cast<int>(balances.size());
}

/// A record's slopes are by the shared unknowns and by its own zero: the selection of both among
/// all unknowns.
Matrix selectionOf(std::size_t r, int n) {
  Matrix selection = Matrix::Zero(n, kBalanceCount + 1);
  selection.topLeftCorner<kBalanceCount, kBalanceCount>().setIdentity();
  selection(kBalanceCount + static_cast<int>(r), kBalanceCount) = 1;
  return selection;
}

Normal normalAt(const std::vector<MomentumBalance>& balances, const Unknowns& u,
                const std::vector<double>& weights) {
  const int n = sizeOf(balances);
  Normal out{Matrix::Zero(n, n), Vector::Zero(n), 0};
  for (std::size_t r = 0; r < balances.size(); ++r) {
    const MomentumBalance::Prediction here = balances[r].predict(u.p, u.zeros[r]);
    const Vector residuals = balances[r].residuals(here);
    const Matrix selection = selectionOf(r, n);
    const Matrix own = here.slope * here.slope.transpose();
    out.A += weights[r] * selection * own * selection.transpose();
    out.g += weights[r] * selection * (here.slope * residuals);
    out.cost += weights[r] * residuals.squaredNorm();
  }
  return out;
}

Unknowns moved(const Unknowns& u, const Vector& step) {
  Unknowns out = u;
  out.p += step.head<kBalanceCount>();
  for (std::size_t r = 0; r < u.zeros.size(); ++r) {
    out.zeros[r] += step[kBalanceCount + static_cast<int>(r)];
  }
  return out;
}

Vector solved(const Matrix& A, const Vector& g) {
  // Columns of such different units are scaled to one size first.
  const Vector scale = A.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const Eigen::LDLT<Matrix> ldlt(scaled);
  if (ldlt.info() != Eigen::Success || ldlt.vectorD().minCoeff() < 1e-12) {
    throw NumericalError(
        "the records do not determine stiffness, inertia and friction: the motor "
        "turned too little, or its current does not show what it did");
  }
  return scale.asDiagonal() * ldlt.solve(scale.asDiagonal() * g);
}

void improve(const std::vector<MomentumBalance>& balances, const std::vector<double>& weights,
             Unknowns& u) {
  double damping = 1e-3;
  Normal here = normalAt(balances, u, weights);
  for (int i = 0; i < kIterations && damping < 1e9; ++i) {
    Matrix damped = here.A;
    damped.diagonal() *= 1 + damping;
    const Unknowns next = moved(u, solved(damped, here.g));
    Normal there = normalAt(balances, next, weights);
    if (!(there.cost < here.cost)) {
      damping *= 8;
      continue;
    }
    const bool settled = here.cost - there.cost < 1e-12 * here.cost;
    u = next;
    here = std::move(there);
    damping *= 0.2;
    if (settled) return;
  }
}

double weightOf(double residual) { return 1 / std::max(1e-18, residual * residual); }

Matrix covarianceAt(const std::vector<MomentumBalance>& balances, const Unknowns& u,
                    const std::vector<double>& weights) {
  const int n = sizeOf(balances);
  const Matrix A = normalAt(balances, u, weights).A;
  Matrix middle = Matrix::Zero(n, n);
  int blocks = 0;
  for (std::size_t r = 0; r < balances.size(); ++r) {
    const MomentumBalance& balance = balances[r];
    const MomentumBalance::Prediction here = balance.predict(u.p, u.zeros[r]);
    const Vector residuals = balance.residuals(here);
    const auto blockOf = [&](int i) {
      return static_cast<int>(balance.sample(i) * balance.record().period / kBlock_s);
    };
    for (int first = 0, next = 0; first < balance.size(); first = next) {
      while (next < balance.size() && blockOf(next) == blockOf(first)) ++next;
      const Vector own =
          here.slope.middleCols(first, next - first) * residuals.segment(first, next - first);
      const Vector score = weights[r] * selectionOf(r, n) * own;
      middle += score * score.transpose();
      ++blocks;
    }
  }
  Matrix inverse(n, n);
  for (int i = 0; i < n; ++i) inverse.col(i) = solved(A, Vector::Unit(n, i));
  const double correction = static_cast<double>(blocks) / std::max(1, blocks - n);
  return correction * inverse * middle * inverse;
}

}  // namespace

double rootMeanSquare(const Eigen::VectorXd& values) {
  return values.size() == 0 ? 0
                            : std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

double residualOf(const MomentumBalance& balance, const BalanceVector& p, double zero) {
  return rootMeanSquare(balance.residuals(balance.predict(p, zero)));
}

double zeroOf(const MomentumBalance& balance, const BalanceVector& p) {
  double zero = balance.meanDeflection();
  for (int iteration = 0; iteration < 20; ++iteration) {
    const MomentumBalance::Prediction here = balance.predict(p, zero);
    const auto slope = here.slope.row(kBalanceCount);
    const double step = slope.dot(balance.residuals(here)) / (1e-12 + slope.squaredNorm());
    zero += step;
    if (std::abs(step) < 1e-9) break;
  }
  return zero;
}

BalanceFit fitBalance(const std::vector<MomentumBalance>& balances, const BalanceFit* start) {
  Unknowns u;
  u.p = start != nullptr ? start->value : kStart;
  for (const MomentumBalance& b : balances) {
    if (b.size() < kFewestEquations) {
      throw NumericalError(fmt::format(
          "record '{}' ({}) has {} samples at which the rotor turns fast enough, at least {} are "
          "needed: more torque, more travel, or a lower --least-speed",
          b.record().name, toText(b.record().posture), b.size(), kFewestEquations));
    }
    u.zeros.push_back(b.meanDeflection());
  }
  std::vector<double> weights(balances.size(), 1);
  if (start != nullptr) {
    u.zeros = start->zeros;
    for (std::size_t r = 0; r < weights.size(); ++r) weights[r] = weightOf(start->residuals[r]);
  }
  BalanceFit fit;
  for (int w = 0; w < (start != nullptr ? 1 : kWeighings); ++w) {
    improve(balances, weights, u);
    fit.residuals.clear();
    for (std::size_t r = 0; r < balances.size(); ++r) {
      fit.residuals.push_back(residualOf(balances[r], u.p, u.zeros[r]));
      weights[r] = weightOf(fit.residuals[r]);
    }
  }
  improve(balances, weights, u);
  fit.value = u.p;
  fit.zeros = u.zeros;
  fit.covariance = covarianceAt(balances, u, weights).topLeftCorner<kBalanceCount, kBalanceCount>();
  return fit;
}

}  // namespace ballbot
