#pragma once

#include <complex>

namespace ballbot {

/// Frequency-dependent weight on inputs (Minniti et al. 2019, section III-C). The cost is taken of
/// r(s) u instead of u, with a lead r = (1 + s/zero) / (1 + s/pole): unchanged weight for slow
/// inputs, (pole/zero)^2 times the weight for those the drives cannot follow. One filter state per
/// input, the low-passed input x_f with dx_f/dt = pole (u - x_f), turns that into a plain quadratic
/// cost of (x_f, u):  r u = rho u - (rho - 1) x_f,  rho = pole / zero.
struct FrequencyShaping {
  double zero = 100;  ///< [rad/s]
  double pole = 200;  ///< [rad/s]; pole = zero is no shaping

  double rho() const { return pole / zero; }
  std::complex<double> filter(double omega) const;  ///< r(j omega)
  double weightRatio(double omega) const { return std::norm(filter(omega)); }

  /// Matched to actuators whose output is down 3 dB at `bandwidth_Hz`: the weight grows from
  /// 3/4 of that frequency on, over 15 times its range.
  static FrequencyShaping forBandwidth(double bandwidth_Hz);
};

/// The filter over one step of length H with u held, exactly:
///
///   x_f+ = a x_f + (1 - a) u,    int (r u)^2 dt = H u^2 + 2 c1 u d + c2 d^2,  d = u - x_f.
///
/// Exact, because the pole is often faster than the step.
struct FilterStep {
  double H = 0, a = 0, c1 = 0, c2 = 0;

  FilterStep() = default;
  FilterStep(const FrequencyShaping& shaping, double step);

  double next(double xf, double u) const { return a * xf + (1 - a) * u; }
  double cost(double xf, double u) const {
    const double d = u - xf;
    return H * u * u + 2 * c1 * u * d + c2 * d * d;
  }
};

}  // namespace ballbot
