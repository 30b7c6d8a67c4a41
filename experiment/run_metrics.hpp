#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cosim/tick.hpp"
#include "experiment/run_config.hpp"
#include "metrics/balance_metrics.hpp"
#include "metrics/contact_metrics.hpp"
#include "metrics/ee_step_metrics.hpp"
#include "metrics/estimation_errors.hpp"
#include "metrics/limit_margins.hpp"
#include "metrics/push_metrics.hpp"
#include "metrics/spin_metrics.hpp"
#include "metrics/tracking_metrics.hpp"
#include "metrics/wheel_metrics.hpp"

namespace ballbot {

/// Name of a metric: share of the tracker's ticks after the release in which an LQR stood in for
/// lack of a plan.
constexpr const char* kFallbackPercent = "fallback_percent";

/// Everything that is measured of a run but what its controller counts itself (docs/metrics.md).
/// Judged from the plant's truth, which no
/// controller sees, in the frame in which the controller lives.
class RunMetrics {
 public:
  explicit RunMetrics(const RunConfig& config);

  /// One tick; without truth nothing is measured.
  void add(const Tick& tick);

  bool fell() const { return balance_.fell(); }
  std::map<std::string, double> values() const;
  /// Every name that values() can have.
  static std::vector<std::string> names();

 private:
  std::shared_ptr<const MotionReference> reference_;
  HomeFrame home_;
  BalanceMetrics balance_;
  PushMetrics push_;
  TrackingMetrics tracking_;
  LimitMargins margins_;
  EeStepMetrics steps_;
  ContactMetrics contact_;
  EstimationErrors estimation_;
  SpinMetrics spin_;
  WheelMetrics wheels_;

  void addBesideTruth(SimTime now, const AddedSignals& added);
  std::vector<std::size_t> places_;  ///< of what the truth has beside its frame
};

}  // namespace ballbot
