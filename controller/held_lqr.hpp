#pragma once

#include <vector>

#include "controller/lqr.hpp"

namespace ballbot {

/// The LQR for torques that are held from each knot of a horizon to the next: one gain per step,
/// tau = tau_eq + K (x - x_eq). A gain for continuous feedback, held for 20 ms, makes a light joint
/// swing up; these cannot, because each is the best of its own step,
///
///   K_k = -(h R + B^T P_{k+1} B)^-1 B^T P_{k+1} A,   P_k = h Q + A^T P_{k+1} (A + B K_k),
///
/// A and B the exact discretisation over the step h of the model about the equilibrium, and P at
/// the end of the horizon that of the continuous LQR.
/// @param knots  ascending times [s]; at least two
std::vector<FeedbackGain> designHeldLqr(const ReducedDynamics& dynamics, const LqrSolution& lqr,
                                        const LqrWeights& weights,
                                        const std::vector<double>& knots);

}  // namespace ballbot
