#pragma once

#include <memory>
#include <vector>

#include "controller/tasks.hpp"
#include "experiment/scenario.hpp"
#include "metrics/ee_step_metrics.hpp"
#include "metrics/home_frame.hpp"

namespace ballbot {

/// What a scenario asks of the end-effector, for those who judge and draw the run.
struct EeReference {
  std::shared_ptr<const TaskSchedule> schedule;  ///< none where another law than an MPC is in charge
  HomeFrame home;                                ///< in which it is meant

  /// Whether it is ever asked to go anywhere.
  bool moves() const;
  /// What is asked for at once; ramps and circles are no steps.
  std::vector<EeStep> steps() const;
  PoseVector at(SimTime t) const;  ///< in the home frame; zero without a schedule
};

/// From the tasks ee_position and ee_orientation of the MPC.
/// @throw InputError as the tasks' own reader.
EeReference readEeReference(const Scenario& scenario);

}  // namespace ballbot
