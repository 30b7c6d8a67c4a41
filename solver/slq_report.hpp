#pragma once

#include "solver/phase_clock.hpp"

namespace ballbot {

struct SlqOptions {
  int threads = 1;           ///< 1, or 2: a helper shares the approximation
  double base_shift = 1e-6;  ///< added to the diagonal of H_u
  double largest_shift = 1e6;
  double armijo = 1e-4;
  int line_search_steps = 4;  ///< 1, 1/2, 1/4, ...
  PhaseClock clock = nullptr;
};

enum class SlqStatus {
  kImproved,   ///< a step was accepted
  kConverged,  ///< nothing left to gain: the predicted decrease is below rounding
  kNoDescent,  ///< no step length lowered the cost
  kNotFinite,  ///< the nominal rollout diverged
  kNotConvex,  ///< H_u not positive definite even at the largest shift
};
const char* slqStatusName(SlqStatus status);

/// What one iteration did.
template <typename Cost>
struct SlqReport {
  SlqStatus status = SlqStatus::kConverged;
  int iterations = 1;
  double nominal_cost = 0;        ///< of the nominal policy from the new initial state
  double cost = 0;                ///< of the result
  double predicted_decrease = 0;  ///< by the quadratic model, for a full step
  double step_length = 0;
  double shift = 0;  ///< Riccati regularisation used
  Cost terms;        ///< of the result
  PhaseTimes times;

  bool ok() const { return status == SlqStatus::kImproved || status == SlqStatus::kConverged; }
};

}  // namespace ballbot
