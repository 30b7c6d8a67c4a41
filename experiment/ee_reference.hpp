#pragma once

#include <vector>

#include "experiment/scenario.hpp"
#include "metrics/ee_step_metrics.hpp"

namespace ballbot {

/// The steps that a scenario asks of the end-effector, for those who judge and draw the run.
struct EeReference {
  PoseVector initial = PoseVector::Zero();  ///< before the first step
  std::vector<EeStep> steps;

  PoseVector at(SimTime t) const;
};

/// From the tasks ee_position and ee_orientation of the MPC; no steps where another law is in
/// charge or nothing is asked. Ramps and circles are not steps and are left out.
/// @throw InputError as the tasks' own reader.
EeReference readEeReference(const Scenario& scenario);

}  // namespace ballbot
