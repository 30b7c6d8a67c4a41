#include "solver/frequency_shaping.hpp"

#include <cmath>

#include "core/angle.hpp"

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

FilterStep::FilterStep(const FrequencyShaping& shaping, double step) {
  const double rho = shaping.rho();
  H = step;
  a = std::exp(-shaping.pole * H);
  c1 = (rho - 1) * (1 - a) / shaping.pole;
  c2 = (rho - 1) * (rho - 1) * (1 - a * a) / (2 * shaping.pole);
}

}  // namespace ballbot
