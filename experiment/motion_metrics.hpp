#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "controller/mpc_planner.hpp"
#include "experiment/scenario.hpp"
#include "metrics/limit_margins.hpp"
#include "metrics/tracking_metrics.hpp"

namespace ballbot {

/// The `mpc` section of the scenario's controller; nothing where another law is in charge.
/// @throw InputError
std::optional<MpcConfig> readMpc(const Scenario& scenario);

/// Where the tasks want ball and end-effector at time t [s], and in which directions they care.
PlaceReference placeReference(const TaskSchedule& schedule, double t);

/// What a scenario's tasks and limits say about a run: how well ball and end-effector were where
/// they should be, and how close the run came to its limits.
class MotionMetrics {
 public:
  /// @throw InputError as the readers of the controller's section.
  explicit MotionMetrics(const Scenario& scenario);

  /// What is asked for at time t; nothing where another law than an MPC is in charge.
  PlaceReference place(SimTime t) const;
  /// @param truth  as seen from the home frame, in which the tasks are meant
  void add(const TruthFrame& truth, const ActuatorCommand& command);

  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

 private:
  std::optional<MpcConfig> mpc_;
  TrackingMetrics tracking_;
  LimitMargins margins_;
};

}  // namespace ballbot
