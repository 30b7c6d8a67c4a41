#include "controller/frequency_shaping.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"
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

void FrequencyShaping::describe(ConfigVisitor& v) {
  bool enabled = true, matched = false;
  v.boolean(may("enabled", "whether fast torques of the wheels cost more than slow ones"), enabled);
  v.other(may("actuator_bandwidth_Hz",
              "sets zero and pole, in place of the two, to suit drives whose torque is down 3 dB "
              "there"),
          "number, 0.1 to 10000", [&](ConfigReader& in) {
            if (in.has("zero_rad_per_s") || in.has("pole_rad_per_s")) {
              throw InputError(
                  fmt::format("{} stands beside zero_rad_per_s or pole_rad_per_s, must be the "
                              "one or the other",
                              in.at("actuator_bandwidth_Hz")));
            }
            *this = forBandwidth(in.number("actuator_bandwidth_Hz", {0.1, 1e4}));
            matched = true;
          });
  if (!matched) {
    v.number(may("zero_rad_per_s", "frequency from which on a wheel's torque costs more"), zero,
             {0.1, 1e5});
    v.number(may("pole_rad_per_s",
                 "frequency beyond which that weight grows no further; at least the zero, "
                 "and the farther above it the more fast torques cost"),
             pole, v.depending({zero, 1e5}));
  }
  if (!enabled) pole = zero;
}

FrequencyShaping FrequencyShaping::read(ConfigReader& in) {
  FrequencyShaping out;
  readDescribed(in, out);
  in.finish();
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
