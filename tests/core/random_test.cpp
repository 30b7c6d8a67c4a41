#include "core/random.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

TEST(RandomStream, DependsOnSeedNameAndIndexOnly) {
  const RandomStream a(1, "imu"), b(1, "imu"), other_seed(2, "imu"), other_name(1, "encoder");
  a.normals(7);  // drawing elsewhere must not matter
  EXPECT_EQ(a.normals(3), b.normals(3));
  EXPECT_NE(a.normals(3), a.normals(4));
  EXPECT_NE(a.normals(3), other_seed.normals(3));
  EXPECT_NE(a.normals(3), other_name.normals(3));
  EXPECT_NE(a.normals(3, 0), a.normals(3, 1));
}

TEST(RandomStream, NormalsHaveMomentsOfTheStandardNormal) {
  const RandomStream stream(42, "moments");
  const int n = 50000;
  double sum = 0, sum2 = 0, sum4 = 0, lag = 0, previous = 0;
  for (int i = 0; i < n; ++i) {
    for (const double x : stream.normals(static_cast<std::uint64_t>(i))) {
      sum += x;
      sum2 += x * x;
      sum4 += x * x * x * x;
      lag += x * previous;
      previous = x;
    }
  }
  const double count = 4.0 * n;  // five standard deviations of each estimate
  EXPECT_NEAR(sum / count, 0, 5 / std::sqrt(count));
  EXPECT_NEAR(sum2 / count, 1, 5 * std::sqrt(2 / count));
  EXPECT_NEAR(sum4 / count, 3, 5 * std::sqrt(96 / count));
  EXPECT_NEAR(lag / count, 0, 5 / std::sqrt(count));
}

TEST(RandomStream, UniformsStayInsideTheOpenInterval) {
  const RandomStream stream(3, "u");
  for (std::uint64_t i = 0; i < 10000; ++i) {
    for (const double u : stream.uniforms(i)) {
      ASSERT_GT(u, 0.0);
      ASSERT_LT(u, 1.0);
    }
  }
}

}  // namespace
}  // namespace ballbot
