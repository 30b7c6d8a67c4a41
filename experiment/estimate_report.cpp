#include "experiment/estimate_report.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_node.hpp"
#include "core/key_unit.hpp"
#include "experiment/build_info.hpp"
#include "experiment/rejection_metrics.hpp"
#include "experiment/text_file.hpp"
#include "experiment/verdict.hpp"
#include "plant/faults.hpp"
#include "report/write_report.hpp"

namespace ballbot {
namespace {

/// Innovations are drawn as means over so many updates: single ones scatter over decades.
constexpr std::size_t kInnovationWindow = 100;

/// Places in EstimateFrame::sigma.
enum SigmaIndex : int {
  kSigmaPx,
  kSigmaPy,
  kSigmaTiltX,
  kSigmaTiltY,
  kSigmaYaw,
  kSigmaVx,
  kSigmaVy
};

PlotSeries columnSeries(const LogTable& table, const std::string& column, const std::string& name,
                        int channel) {
  return {name, SeriesStyle::kMeasured, channel, table.column("time_s"), table.column(column)};
}

/// +-2 sigma of an estimate as two dashed lines in the colour of `channel`.
void addBounds(const LogEstimate& e, int sigma, double scale, int channel, PlotAxes& axes) {
  for (const double sign : {2.0, -2.0}) {
    PlotSeries bound{sign > 0 ? "two sigma" : "", SeriesStyle::kReference, channel, {}, {}};
    for (const auto& m : e.estimates) {
      bound.t.push_back(toSeconds(m.time));
      bound.values.push_back(sign * scale * m.sigma[sigma]);
    }
    axes.series.push_back(std::move(bound));
  }
}

PlotAxes errorAxes(const LogEstimate& e, const char* quantity, const char* unit,
                   const std::vector<std::pair<const char*, int>>& columns, double sigma_scale) {
  PlotAxes axes{quantity, unit, {}, {}};
  int channel = 0;
  for (const auto& [column, sigma] : columns) {
    axes.series.push_back(columnSeries(e.errors, column, column, channel));
    addBounds(e, sigma, sigma_scale, channel++, axes);
  }
  return axes;
}

PlotGroup errorGroup(const LogEstimate& e) {
  return {"Errors",
          "Truth less estimate. Nineteen of twenty samples of what the sensors can see, tilt and "
          "velocity, should lie between the dashed lines. Position and yaw cannot be seen without "
          "an external pose: their bounds grow.",
          {errorAxes(e, "tilt error", "deg", {{"tilt_x", kSigmaTiltX}, {"tilt_y", kSigmaTiltY}},
                     kDegPerRad),
           errorAxes(e, "velocity error", "m/s", {{"vx", kSigmaVx}, {"vy", kSigmaVy}}, 1),
           errorAxes(e, "position error", "m", {{"px", kSigmaPx}, {"py", kSigmaPy}}, 1),
           errorAxes(e, "yaw error", "deg", {{"yaw", kSigmaYaw}}, kDegPerRad)},
          {}};
}

PlotGroup biasGroup(const LogEstimate& e) {
  PlotAxes accel{"accelerometer bias", "m/s^2", {}, {}}, gyro{"gyroscope bias", "rad/s", {}, {}};
  int channel = 0;
  for (const char* axis : {"x", "y", "z"}) {
    accel.series.push_back(
        columnSeries(e.errors, std::string("accel_bias_") + axis, axis, channel));
    gyro.series.push_back(columnSeries(e.errors, std::string("gyro_bias_") + axis, axis, channel));
    ++channel;
  }
  return {"Biases",
          "As estimated; they settle within seconds once the robot moves.",
          {accel, gyro},
          {}};
}

/// NIS over its degrees of freedom, which should scatter about one.
PlotGroup innovationGroup(const LogEstimate& e) {
  PlotSeries ratio{"NIS / degrees of freedom", SeriesStyle::kMeasured, 0, {}, {}};
  const std::vector<double>& t = e.errors.column("time_s");
  const std::vector<double>& nis = e.errors.column("nis");
  const std::vector<double>& degrees = e.errors.column("nis_degrees");
  double nis_sum = 0, degrees_sum = 0;
  std::size_t samples = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (!std::isfinite(nis[k])) continue;
    nis_sum += nis[k];
    degrees_sum += degrees[k];
    if (++samples < kInnovationWindow) continue;
    ratio.t.push_back(t[k]);
    ratio.values.push_back(degrees_sum > 0 ? nis_sum / degrees_sum : std::nan(""));
    nis_sum = degrees_sum = 0;
    samples = 0;
  }
  return {"Innovations",
          "Means over a quarter of a second. One: the noise is as the filter thinks; less: the "
          "filter is cautious; more: it trusts its sensors too much.",
          {{"NIS per degree of freedom", "", {std::move(ratio)}, {}}},
          {}};
}

PlotGroup rejectionGroup(const LogEstimate& e) {
  PlotAxes axes{"rejected so far", "", {}, {}};
  int channel = 0;
  for (const auto& [reason, count] : rejectionsAmong(e.metrics)) {
    axes.series.push_back(columnSeries(e.errors, "rejected_" + reason, reason, channel++ % 6));
  }
  return {"Rejections",
          "A step is a fault; docs/troubleshooting says what each name means.",
          {axes},
          {}};
}

std::string verdictText(const LogEstimate& e) {
  if (e.identical()) return "identical to the online estimate";
  if (!e.first_difference) return "nothing recorded to compare with";
  return fmt::format("differs from the online estimate from {} on", toText(*e.first_difference));
}

}  // namespace

void writeEstimateReport(const RunConfig& config, const LogEstimate& e, bool should_be_identical,
                         const std::string& path) {
  const Scenario& scenario = config.scenario;
  ReportData data;
  data.title = "Estimate of " + scenario.name;
  data.subtitle = "The recorded sensors, played to the estimator again.";
  data.passed = !should_be_identical || !e.first_difference;
  data.verdict = verdictText(e);
  const auto rejected = rejectionsAmong(e.metrics);
  data.headline = {{"estimates", std::to_string(e.estimates.size())},
                   {"rejected", rejectionText(rejected)}};
  for (const auto& [name, value] : e.metrics) {
    if (name.rfind("rejected_", 0) != 0) data.metrics.push_back({"", name, value, unitOfKey(name)});
  }
  for (const auto& [reason, count] : rejected)
    data.metrics.push_back({"Rejected", reason, count, ""});
  if (e.has_truth) data.groups.push_back(errorGroup(e));
  if (e.metrics.count("nis_mean")) {
    data.groups.push_back(biasGroup(e));
    data.groups.push_back(innovationGroup(e));
  }
  if (!rejected.empty()) data.groups.push_back(rejectionGroup(e));
  if (scenario.release > kSimStart) {
    data.phases.push_back(
        {ReportPhase::Kind::kHold, 0, toSeconds(scenario.release), "held in the stand"});
  }
  for (const Fault& fault : config.plant.plant.faults) {
    data.phases.push_back(
        {ReportPhase::Kind::kFault, toSeconds(fault.start), toSeconds(fault.end()), toText(fault)});
  }
  for (const auto& [key, value] : buildInfo()) data.manifest.push_back({key, value});
  data.documents = {{"estimator", toYaml(scenario.section("estimator"))}};
  data.start_s = 0;
  data.end_s = toSeconds(e.estimates.back().time);
  writeReport(data, readTextFile(scenario.urdf_path), path);
}

}  // namespace ballbot
