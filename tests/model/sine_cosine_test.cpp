#include "model/sine_cosine.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace ballbot {
namespace {

TEST(SineCosine, AgreesWithExtendedPrecision) {
  const RandomStream stream(1, "angles");
  for (const double range : {1e-3, 1.0, 10.0, 1e3, 1e6}) {
    for (int n = 0; n < 2000; ++n) {
      double angle[8], sine[8], cosine[8];
      for (int i = 0; i < 8; ++i) angle[i] = range * (2 * stream.uniforms(n, i / 4)[i % 4] - 1);
      sineCosine8(angle, sine, cosine);
      for (int i = 0; i < 8; ++i) {
        const auto exact_sine = static_cast<double>(std::sin(static_cast<long double>(angle[i])));
        const auto exact_cosine = static_cast<double>(std::cos(static_cast<long double>(angle[i])));
        EXPECT_NEAR(sine[i], exact_sine, 3e-16 * std::abs(exact_sine)) << angle[i];
        EXPECT_NEAR(cosine[i], exact_cosine, 3e-16 * std::abs(exact_cosine)) << angle[i];
      }
    }
  }
}

TEST(SineCosine, GivesTheFourQuadrantsAndKeepsNaN) {
  const double half_pi = 1.5707963267948966;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double angle[8] = {0,        half_pi,      2 * half_pi, 3 * half_pi,
                           -half_pi, -2 * half_pi, nan,         4 * half_pi};
  const double expected_sine[6] = {0, 1, 0, -1, -1, 0}, expected_cosine[6] = {1, 0, -1, 0, 0, -1};
  double sine[8], cosine[8];
  sineCosine8(angle, sine, cosine);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(sine[i], expected_sine[i], 4e-16);
    EXPECT_NEAR(cosine[i], expected_cosine[i], 4e-16);
  }
  EXPECT_TRUE(std::isnan(sine[6]) && std::isnan(cosine[6]));
  EXPECT_NEAR(cosine[7], 1, 1e-15);
}

}  // namespace
}  // namespace ballbot
