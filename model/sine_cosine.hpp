#pragma once

#include <cmath>

namespace ballbot {

/// Sines and cosines of eight angles at once, for |angle| < 1e6 rad, with an error below 3e-16.
/// Several times faster than calls of the C library, and the same bits whatever that library is.
inline void sineCosine8(const double* angle, double* sine, double* cosine) noexcept {
  constexpr double kTwoOverPi = 0.63661977236758134308;
  constexpr double kHalfPiHigh = 1.57079632679489655800;     // nearest double to pi/2
  constexpr double kHalfPiLow = 6.12323399573676603587e-17;  // the rest of it
  constexpr double kRounder = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
  for (int i = 0; i < 8; ++i) {
    // angle = k pi/2 + r with |r| <= pi/4; fma keeps the product exact through the cancellation.
    const double k = (angle[i] * kTwoOverPi + kRounder) - kRounder;
    const double r = std::fma(-k, kHalfPiLow, std::fma(-k, kHalfPiHigh, angle[i]));
    const double z = r * r;
    // Taylor series; the first term left out is below 1e-18.
    double s = 1.0 / 355687428096000.0;
    s = std::fma(s, z, -1.0 / 1307674368000.0);
    s = std::fma(s, z, 1.0 / 6227020800.0);
    s = std::fma(s, z, -1.0 / 39916800.0);
    s = std::fma(s, z, 1.0 / 362880.0);
    s = std::fma(s, z, -1.0 / 5040.0);
    s = std::fma(s, z, 1.0 / 120.0);
    s = std::fma(s, z, -1.0 / 6.0);
    s = std::fma(s * z, r, r);
    double c = 1.0 / 20922789888000.0;
    c = std::fma(c, z, -1.0 / 87178291200.0);
    c = std::fma(c, z, 1.0 / 479001600.0);
    c = std::fma(c, z, -1.0 / 3628800.0);
    c = std::fma(c, z, 1.0 / 40320.0);
    c = std::fma(c, z, -1.0 / 720.0);
    c = std::fma(c, z, 1.0 / 24.0);
    c = std::fma(c, z, -0.5);
    c = std::fma(c, z, 1.0);
    // k modulo 4, as -2 to 2, says which of the two it is and with which sign.
    const double quadrant = k - 4 * ((0.25 * k + kRounder) - kRounder);
    const bool swapped = std::fabs(quadrant) == 1;
    const double s_out = swapped ? c : s, c_out = swapped ? s : c;
    sine[i] = std::fabs(quadrant - 0.5) <= 1 ? s_out : -s_out;    // quadrants 0 and 1
    cosine[i] = std::fabs(quadrant + 0.5) <= 1 ? c_out : -c_out;  // quadrants 0 and -1
  }
}

}  // namespace ballbot
