#include "solver/horizon.hpp"

#include <gmock/gmock.h>

namespace ballbot {
namespace {

using testing::DoubleNear;
using testing::Pointwise;

TEST(Horizon, HasFineStepsFirstAndThenCoarseOnes) {
  Horizon horizon;
  horizon.fine_length = 0.03;
  horizon.fine_step = 0.01;
  horizon.length = 0.13;
  horizon.coarse_step = 0.05;
  const std::vector<double> expected = {0, 0.01, 0.02, 0.03, 0.08, 0.13};
  EXPECT_THAT(horizon.knots(), Pointwise(DoubleNear(1e-15), expected));
}

TEST(Horizon, IsEvenWithoutAFinePart) {
  Horizon horizon;
  horizon.length = 0.06;
  const std::vector<double> expected = {0, 0.02, 0.04, 0.06};
  EXPECT_THAT(horizon.knots(), Pointwise(DoubleNear(1e-15), expected));
}

}  // namespace
}  // namespace ballbot
