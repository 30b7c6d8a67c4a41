#include "tools/identify_report.hpp"

#include <fmt/format.h>

#include "core/angle.hpp"

namespace ballbot {
namespace {

using Json = nlohmann::ordered_json;

Json responseJson(const TorqueResponse& r) {
  Json j;
  j["bandwidth_Hz"] = r.bandwidth_Hz();
  j["natural_frequency_Hz"] = r.natural_frequency / kTwoPi;
  j["natural_frequency_sigma_Hz"] = r.natural_frequency_sigma / kTwoPi;
  if (r.order == 2) {
    j["damping_ratio"] = r.damping_ratio;
    j["damping_ratio_sigma"] = r.damping_ratio_sigma;
  }
  j["delay_ms"] = 1e3 * r.delay;
  j["delay_sigma_ms"] = 1e3 * r.delay_sigma;
  j["rms_error"] = r.residual;
  return j;
}

Json figureJson(const Figure& f, const Configured& configured) {
  Json j;
  j["name"] = f.name;
  j["unit"] = f.unit;
  j["value"] = f.identified ? Json(f.value) : Json(nullptr);
  j["sigma"] = f.identified ? Json(f.sigma) : Json(nullptr);
  const Verdict v = verdictOf(f, configured);
  if (v.has_configured) j["configured"] = v.configured;
  j["verdict"] = v.text;
  return j;
}

Json correlationJson(const Figures& figures) {
  Json j;
  int n = 0;
  for (const Figure& f : figures.list) {
    if (!f.identified) continue;
    j["figures"].push_back(f.key);
    Json row = Json::array();
    for (int i = 0; i < figures.correlation.cols(); ++i) row.push_back(figures.correlation(n, i));
    j["matrix"].push_back(row);
    ++n;
  }
  return j;
}

}  // namespace

Json identificationJson(const Identification& found, const Configured& configured,
                        const std::string& drive) {
  Json j;
  j["drive"] = drive;
  for (const Figure& f : found.figures.list) j["figures"][f.key] = figureJson(f, configured);
  j["correlation"] = correlationJson(found.figures);
  for (const Validation& v : found.validation) {
    j["held_out"].push_back({{"record", v.record},
                             {"predicts", v.what},
                             {"fit_percent", v.fit_percent},
                             {"growth", v.growth},
                             {"good", v.good}});
  }
  j["valid"] = found.valid();
  j["first_order"] = responseJson(found.first);
  j["second_order"] = responseJson(found.second);
  j["torque_bandwidth_Hz"] = identifiedActuator(found, configured).torque_bandwidth;
  for (const ResponsePoint& p : found.points) {
    j["points"].push_back({{"frequency_Hz", p.frequency_Hz},
                           {"gain", std::abs(p.value)},
                           {"phase_deg", std::arg(p.value) * kDegPerRad}});
  }
  return j;
}

std::string identificationTable(const Identification& found, const Configured& configured,
                                const std::string& drive) {
  std::string out = fmt::format("{:<24} {:>10} {:>10} {:>10} {:<8} {}\n", drive, "value", "sigma",
                                "configured", "", "verdict");
  for (const Figure& f : found.figures.list) {
    const Verdict v = verdictOf(f, configured);
    const std::string was = v.has_configured ? fmt::format("{:.4g}", v.configured) : "";
    out += fmt::format("{:<24} {:>10} {:>10} {:>10} {:<8} {}\n", f.name,
                       f.identified ? fmt::format("{:.4g}", f.value) : "",
                       f.identified ? fmt::format("{:.2g}", f.sigma) : "", was, f.unit, v.text);
  }
  out += fmt::format("\n{:<40} {:<14} {:>8} {:>8}\n", "held out", "predicts", "fit", "growth");
  for (const Validation& v : found.validation) {
    out += fmt::format("{:<40} {:<14} {:>6.1f} % {:>8.2f} {}\n", v.record, v.what, v.fit_percent,
                       v.growth, v.good ? "good" : "does not fit");
  }
  const TorqueResponse& r = found.second;
  return out + fmt::format(
                   "\nFor this drive in the bench file: torque_frequency_Hz: {:.4g}, "
                   "torque_damping_ratio: {:.3g}, torque_delay_ms: {:.3g}\n",
                   r.natural_frequency / kTwoPi, r.damping_ratio, 1e3 * std::max(0.0, r.delay));
}

nlohmann::ordered_json trialsJson(const IdentifyTrials& trials) {
  Json j;
  j["seeds"] = trials.seeds;
  j["invalid"] = trials.invalid;
  j["percent_within_two_sigma"] = trials.percentWithinTwoSigma();
  j["percent_within_two_sigma_or_five_percent"] = trials.percentGood();
  j["rms_z"] = trials.rmsZ();
  for (const FigureTrials& f : trials.figures) {
    j["figures"].push_back({{"key", f.key},
                            {"name", f.name},
                            {"unit", f.unit},
                            {"truth", f.truth},
                            {"mean", f.mean()},
                            {"sigma", f.sigmas.front()},
                            {"rms_z", f.rmsZ()},
                            {"within_two_sigma", f.withinTwoSigma()},
                            {"good", f.good()}});
  }
  return j;
}

std::string trialsTable(const IdentifyTrials& trials) {
  std::string out = fmt::format("{:<24} {:>10} {:>10} {:>10} {:>8} {:>10} {}\n", "figure", "truth",
                                "mean", "sigma", "rms z", "within 2", "unit");
  for (const FigureTrials& f : trials.figures) {
    out += fmt::format("{:<24} {:>10.5g} {:>10.5g} {:>10.2g} {:>8.2f} {:>10} {}\n", f.name, f.truth,
                       f.mean(), f.sigmas.front(), f.rmsZ(), f.withinTwoSigma(), f.unit);
  }
  return out +
         fmt::format(
             "{} seeds: {:.1f} % within two sigma, rms of all errors over their sigma {:.2f}; "
             "{:.1f} % within two sigma or 5 %\n",
             trials.seeds, trials.percentWithinTwoSigma(), trials.rmsZ(), trials.percentGood());
}

}  // namespace ballbot
