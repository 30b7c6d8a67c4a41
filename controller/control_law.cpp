#include "controller/control_law.hpp"

namespace ballbot {

const char* planStatusName(PlanStatus status) {
  switch (status) {
    case PlanStatus::kNothingToSolve:
      return "nothing to solve";
    case PlanStatus::kImproved:
      return "improved";
    case PlanStatus::kConverged:
      return "converged";
    case PlanStatus::kNoDescent:
      return "no descent";
    case PlanStatus::kNotFinite:
      return "not finite";
    case PlanStatus::kNotConvex:
      return "not convex";
    case PlanStatus::kStateNotFinite:
      return "state not finite";
  }
  return "";
}

}  // namespace ballbot
