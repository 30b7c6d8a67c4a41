#include "experiment/estimate_log.hpp"

#include <cstring>
#include <limits>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"
#include "experiment/rejection_metrics.hpp"
#include "experiment/robot_sensing.hpp"
#include "model/signal_table.hpp"

namespace ballbot {
namespace {

/// One row per estimate, in the units people read.
class ErrorTable {
 public:
  ErrorTable() {
    table_.name = "estimation_error";
    const char* const columns[][2] = {{"time_s", "s"},
                                      {"tilt_x", "deg"},
                                      {"tilt_y", "deg"},
                                      {"vx", "m/s"},
                                      {"vy", "m/s"},
                                      {"px", "m"},
                                      {"py", "m"},
                                      {"yaw", "deg"},
                                      {"accel_bias_x", "m/s^2"},
                                      {"accel_bias_y", "m/s^2"},
                                      {"accel_bias_z", "m/s^2"},
                                      {"gyro_bias_x", "rad/s"},
                                      {"gyro_bias_y", "rad/s"},
                                      {"gyro_bias_z", "rad/s"},
                                      {"nis", ""},
                                      {"nis_degrees", ""}};
    for (const auto& column : columns) table_.columns.push_back({column[0], column[1], {}});
    for (int i = 0; i < kRejectionCount; ++i) {
      table_.columns.push_back(
          {std::string("rejected_") + toText(static_cast<Rejection>(i)), "", {}});
    }
  }

  void add(SimTime time, const EstimationError* e, const Estimator& estimator) {
    const auto own = estimator.selfAssessment();
    next_ = 0;
    put(decimalSeconds(toNs(time)));
    put(e ? kDegPerRad * e->tilt_W.x() : kNone);
    put(e ? kDegPerRad * e->tilt_W.y() : kNone);
    for (int i = 0; i < 2; ++i) put(e ? e->velocity_W[i] : kNone);
    for (int i = 0; i < 2; ++i) put(e ? e->position_W[i] : kNone);
    put(e ? kDegPerRad * e->yaw : kNone);
    for (int i = 0; i < 3; ++i) put(own ? own->accel_bias[i] : kNone);
    for (int i = 0; i < 3; ++i) put(own ? own->gyro_bias[i] : kNone);
    put(own ? own->nis : kNone);
    put(own ? own->nis_degrees : kNone);
    const RejectionCounts counts = estimator.rejections();
    for (int i = 0; i < kRejectionCount; ++i) {
      put(static_cast<double>(counts[static_cast<Rejection>(i)]));
    }
  }
  LogTable take() { return std::move(table_); }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  void put(double value) { table_.columns[next_++].values.push_back(value); }
  LogTable table_;
  std::size_t next_ = 0;
};

/// Holds new estimates against the recorded ones of the same time, in the order of time.
class OnlineComparison {
 public:
  explicit OnlineComparison(const std::vector<EstimateFrame>& recorded)
      : recorded_(recorded),
        row_(rowSize(estimateSignals())),
        recorded_row_(rowSize(estimateSignals())) {}

  void add(const EstimateFrame& estimate, LogEstimate& out) {
    while (next_ < recorded_.size() && recorded_[next_].time < estimate.time) ++next_;
    if (next_ == recorded_.size() || recorded_[next_].time != estimate.time) return;
    ++out.compared;
    readSignals(estimateSignals(), estimate, row_.data());
    readSignals(estimateSignals(), recorded_[next_], recorded_row_.data());
    const std::size_t size = sizeof(double) * row_.size();
    if (std::memcmp(row_.data(), recorded_row_.data(), size) != 0 && !out.first_difference) {
      out.first_difference = estimate.time;
    }
  }

 private:
  const std::vector<EstimateFrame>& recorded_;
  std::size_t next_ = 0;
  std::vector<double> row_, recorded_row_;
};

}  // namespace

LogEstimate estimateLog(const RunConfig& config, const RunLog& log) {
  const Scenario& scenario = config.scenario;
  if (log.sensors.empty()) {
    throw InputError("the log holds no sensor frames; " +
                     (log.damage.none() ? std::string("was recording.sensors_period_ms negative?")
                                        : "it is " + log.damage.text()));
  }
  RobotSensing sensing(config);
  const SimDuration period = scenario.rates.estimator;
  const HomeFrame& home = config.home;
  EstimationErrors errors(scenario.release);
  ErrorTable table;
  OnlineComparison comparison(log.estimates);
  LogEstimate out;
  out.has_truth = !log.truth.empty();
  auto truth = log.truth.begin();
  std::int64_t last_period = -1;
  for (const SensorFrame& frame : log.sensors) {
    const std::int64_t in_period = frame.time.time_since_epoch() / period;
    if (in_period <= last_period) continue;
    last_period = in_period;
    sensing.update(frame);
    EstimateFrame estimate;
    sensing.write(frame.time, estimate);
    comparison.add(estimate, out);
    out.estimates.push_back(estimate);

    while (truth != log.truth.end() && truth->time < frame.time) ++truth;
    const bool known = truth != log.truth.end() && truth->time == frame.time;
    if (known) {
      errors.add(home.see(*truth), estimate.state);
      if (const auto own = sensing.estimator().selfAssessment()) errors.addConsistency(*own);
    }
    table.add(frame.time, known && errors.started() ? &errors.last() : nullptr,
              sensing.estimator());
  }
  out.metrics = errors.values();
  for (const auto& count : rejectionMetrics(sensing.estimator().rejections()))
    out.metrics.insert(count);
  out.errors = table.take();
  return out;
}

}  // namespace ballbot
