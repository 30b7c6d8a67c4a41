#include "controller/frequency_shaping.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {

std::complex<double> FrequencyShaping::filter(double omega) const {
  const std::complex<double> s(0, omega);
  return (1.0 + s / zero) / (1.0 + s / pole);
}

FrequencyShaping FrequencyShaping::forBandwidth(double bandwidth_Hz) {
  FrequencyShaping out;
  out.zero = 0.75 * kTwoPi * bandwidth_Hz;
  out.pole = 15 * out.zero;
  return out;
}

FrequencyShaping FrequencyShaping::read(ConfigReader& in) {
  FrequencyShaping out;
  const bool enabled = in.booleanOr("enabled", true);
  if (in.has("actuator_bandwidth_Hz")) {
    if (in.has("zero_rad_per_s") || in.has("pole_rad_per_s")) {
      throw InputError(
          fmt::format("{} stands beside zero_rad_per_s or pole_rad_per_s, must be the "
                      "one or the other",
                      in.at("actuator_bandwidth_Hz")));
    }
    out = forBandwidth(in.number("actuator_bandwidth_Hz", {0.1, 1e4}));
  } else {
    out.zero = in.numberOr("zero_rad_per_s", out.zero, {0.1, 1e5});
    out.pole = in.numberOr("pole_rad_per_s", out.pole, {out.zero, 1e5});
  }
  in.finish();
  if (!enabled) out.pole = out.zero;
  return out;
}

FilterStep::FilterStep(const FrequencyShaping& shaping, double step) {
  const double rho = shaping.rho();
  H = step;
  a = std::exp(-shaping.pole * H);
  c1 = (rho - 1) * (1 - a) / shaping.pole;
  c2 = (rho - 1) * (rho - 1) * (1 - a * a) / (2 * shaping.pole);
}

}  // namespace ballbot
