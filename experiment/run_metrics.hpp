#pragma once

#include <map>
#include <string>
#include <vector>

#include "cosim/tick.hpp"
#include "experiment/ee_reference.hpp"
#include "experiment/motion_metrics.hpp"
#include "experiment/robot_controller.hpp"
#include "experiment/scenario.hpp"
#include "metrics/balance_metrics.hpp"
#include "metrics/contact_metrics.hpp"
#include "metrics/ee_step_metrics.hpp"
#include "metrics/estimation_errors.hpp"
#include "metrics/push_metrics.hpp"

namespace ballbot {

/// Everything that is measured of a run (docs/metrics.md). Judged from the plant's truth, which no
/// controller sees, in the frame in which the controller lives.
class RunMetrics {
 public:
  /// @throw InputError with file, line and column.
  explicit RunMetrics(const Scenario& scenario);

  /// One tick; without truth nothing is measured.
  /// @param controller  the one of this run, asked what it thinks of its own estimate
  void add(const Tick& tick, const RobotController& controller);

  bool fell() const { return balance_.fell(); }
  /// With what the controller itself has counted.
  std::map<std::string, double> values(const RobotController& controller) const;
  /// Every name that values() can have.
  static std::vector<std::string> names(const RobotController& controller);

 private:
  EeReference reference_;
  BalanceMetrics balance_;
  PushMetrics push_;
  MotionMetrics motion_;
  EeStepMetrics steps_;
  ContactMetrics contact_;
  EstimationErrors estimation_;
};

}  // namespace ballbot
