#include "controller/held_lqr.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace ballbot {
namespace {

/// x_{k+1} = A x_k + B tau_k.
struct HeldModel {
  StateJacobian A;
  TorqueJacobian B;
};

/// Exponential of [a b; 0 0] h: the series over a fraction of the step in which it converges fast,
/// then doubled, A(2h) = A(h)^2, B(2h) = (A(h) + 1) B(h).
HeldModel heldFor(const StateJacobian& a, const TorqueJacobian& b, double h) {
  constexpr double kSmall = 0.1;
  constexpr int kTerms = 10;
  const double size = h * a.cwiseAbs().rowwise().sum().maxCoeff();
  const int doublings = std::max(0, static_cast<int>(std::ceil(std::log2(size / kSmall))));
  const double part = std::ldexp(h, -doublings);
  HeldModel held;
  StateJacobian term = StateJacobian::Identity();  // (a part)^n / n!
  held.A = term;
  StateJacobian integral = part * term;
  for (int n = 1; n <= kTerms; ++n) {
    term = (term * a * (part / n)).eval();
    held.A += term;
    integral += part / (n + 1) * term;
  }
  held.B = integral * b;
  for (int i = 0; i < doublings; ++i) {
    held.B = (held.A * held.B + held.B).eval();
    held.A = (held.A * held.A).eval();
  }
  return held;
}

}  // namespace

std::vector<FeedbackGain> designHeldLqr(const ReducedDynamics& dynamics, const LqrSolution& lqr,
                                        const LqrWeights& weights,
                                        const std::vector<double>& knots) {
  ReducedDynamics::Linearization model;
  dynamics.linearize(lqr.equilibrium.x, lqr.equilibrium.tau, Vector3::Zero(), model);
  const StateJacobian Q = weights.stateWeight();
  const JointVector R = weights.torqueWeight();
  std::vector<FeedbackGain> gains(knots.size() - 1);
  StateJacobian P = lqr.P;
  for (std::size_t k = gains.size(); k-- > 0;) {
    const double h = knots[k + 1] - knots[k];
    const auto [A, B] = heldFor(model.df_dx, model.df_dtau, h);
    Eigen::Matrix<double, kJointCount, kJointCount> H = B.transpose() * P * B;
    H.diagonal() += h * R;
    const FeedbackGain PA = B.transpose() * P * A;
    gains[k] = -H.llt().solve(PA);
    P = (h * Q + A.transpose() * P * (A + B * gains[k])).eval();
    P = (0.5 * (P + P.transpose())).eval();
  }
  return gains;
}

}  // namespace ballbot
