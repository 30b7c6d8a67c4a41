#pragma once

#include <cmath>

#include "solver/slq_report.hpp"

namespace ballbot {

/// Sum of the sizes of all terms: what rounding in their total is relative to.
template <typename Cost>
double magnitude(const Cost& cost) {
  double sum = 1;
  for (double v : cost.value) sum += std::abs(v);
  return sum;
}

/// What a solver cannot tell apart, relative to the cost's terms.
struct CostNoise {
  double evaluation;  ///< two evaluations of one cost may differ by this
  double prediction;  ///< a predicted decrease below this may be none
};

/// Backtracking from a full step (Armijo). `report` comes with nominal cost and predicted decrease
/// and leaves with cost, terms, step length and status. An iteration with nothing left to gain is
/// accepted as converged even where noise hides the descent, and so is one that changed nothing.
/// @param tryStep  rolls out with a step length; returns the cost
/// @return whether the last rollout of tryStep is the new solution
template <typename Cost, typename TryStep>
bool searchAlongLine(const Cost& nominal, const SlqOptions& options, const CostNoise& noise,
                     const TryStep& tryStep, SlqReport<Cost>& report) {
  const double d = report.predicted_decrease;
  const double size = magnitude(nominal);
  const bool nothing_to_gain = d <= noise.prediction * size;
  bool accepted = false;
  double alpha = 1;
  for (int i = 0; i < options.line_search_steps && !accepted; ++i) {
    if (i > 0) alpha /= 2;
    report.terms = tryStep(alpha);
    report.cost = report.terms.total();
    // The quadratic model falls at the rate 2 d from alpha = 0.
    accepted = report.cost <=
               report.nominal_cost - options.armijo * alpha * 2 * d + noise.evaluation * size;
  }
  report.step_length = accepted ? alpha : 0;
  if (!accepted && nothing_to_gain) {
    report.terms = tryStep(0.0);  // the nominal itself, with the new gains
    report.cost = report.terms.total();
    accepted = true;
  }
  if (!accepted) {
    report.cost = report.nominal_cost;
    report.status = SlqStatus::kNoDescent;
  } else {
    const bool stands =
        std::abs(report.nominal_cost - report.cost) <= 0.1 * noise.evaluation * size;
    report.status = nothing_to_gain || stands ? SlqStatus::kConverged : SlqStatus::kImproved;
  }
  return accepted;
}

}  // namespace ballbot
