#include "solver/slq_report.hpp"

namespace ballbot {

const char* slqStatusName(SlqStatus status) {
  switch (status) {
    case SlqStatus::kImproved:
      return "improved";
    case SlqStatus::kConverged:
      return "converged";
    case SlqStatus::kNoDescent:
      return "no descent";
    case SlqStatus::kNotFinite:
      return "not finite";
    case SlqStatus::kNotConvex:
      return "not convex";
  }
  return "";
}

}  // namespace ballbot
