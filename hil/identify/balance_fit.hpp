#pragma once

#include <vector>

#include "hil/identify/momentum_balance.hpp"

namespace ballbot {

struct BalanceFit {
  BalanceVector value = BalanceVector::Zero();
  /// Of the estimate, from the residuals themselves: they need be neither white nor alike.
  BalanceMatrix covariance = BalanceMatrix::Zero();
  std::vector<double> zeros;      ///< of the deflection, one a record [rad]
  std::vector<double> residuals;  ///< rms of what the model leaves, one a record [N m]
};

/// Nonlinear least squares (Gauss-Newton, after Levenberg and Marquardt) of the balance over all
/// records, each weighed by its residual. The covariance is the sandwich A^-1 S A^-1 with S from
/// sums over blocks of 0.1 s (Liang and Zeger 1986), within which residuals may depend on each
/// other.
/// @throw NumericalError if the records do not determine the unknowns.
/// @param start  of the search: an earlier fit of the same records, or null
BalanceFit fitBalance(const std::vector<MomentumBalance>& balances,
                      const BalanceFit* start = nullptr);

/// Rms of what the model leaves of a record's motor torque [N m].
double residualOf(const MomentumBalance& balance, const BalanceVector& p, double zero);

/// The zero of a record's deflection that fits best with everything else known [rad].
double zeroOf(const MomentumBalance& balance, const BalanceVector& p);

double rootMeanSquare(const Eigen::VectorXd& values);

}  // namespace ballbot
