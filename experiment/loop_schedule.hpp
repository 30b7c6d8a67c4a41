#pragma once

#include <vector>

#include "core/time.hpp"
#include "experiment/run_config.hpp"

namespace ballbot {

/// What happens at one instant of a run, in this order: IMU and encoders are read, then estimator,
/// plan in force, new plan and tracker (RobotController), then the drives act.
struct LoopEvent {
  bool imu = false;       ///< a sample closes its interval
  bool drives = false;    ///< tick: encoders are read, torques asked of the motors
  bool estimate = false;  ///< the estimator takes the newest sample and the joints
  bool activate = false;  ///< the plan that waits acts from here on
  bool plan = false;      ///< one is made
  bool at_once = false;   ///< and acts from here on
  bool track = false;
  SimDuration imu_age{};    ///< since the sample that the estimate is from
  SimDuration frame_age{};  ///< since the joints that it is from
  SimDuration plan_age{};   ///< since the plan in force was made
  SimDuration until_next{};
};

/// When each part of a loop acts, over the shortest time after which everything comes again.
struct LoopSchedule {
  SimDuration period{};
  std::vector<LoopEvent> events;
};

struct LoopPeriods {
  SimDuration drives, imu, estimator, planner, tracker, plan_latency;
};
LoopPeriods loopPeriods(const RunConfig& config);

/// @throw InputError if the rates come together again only after more than ten seconds.
LoopSchedule makeLoopSchedule(const LoopPeriods& periods);

}  // namespace ballbot
