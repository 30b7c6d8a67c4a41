// Where a pose is held, robot and end-effector are where they are asked to be; and an arm of which
// nothing is asked stays where it is.
#include <cmath>
#include <cstdio>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/tools/scenario_run.hpp"

namespace ballbot {
namespace {

class HeldPose : public ::testing::TestWithParam<std::string> {};

// Means would be 2 mm; what is left at one instant is the sway that dry friction leaves.
TEST_P(HeldPose, IsWhereItWasAskedFor) {
  const std::string by = GetParam();
  const auto json = summaryOf(
      {"balance",
       {"duration_s=12", "requirements={}", "initial.pitch_deg=0",
        "controller.mpc.tasks.ee_orientation.weight=0", "controller.mpc.tasks.yaw.weight=0",
        "controller.mpc.tasks.ee_position={weight: 600, reference: {moves: [{at_s: 2, by: [" + by +
            "]}]}}"}});
  EXPECT_LT(json["metrics"]["ee_position_error_m"].get<double>(), 0.005);
  EXPECT_LT(json["final_ball_position_error_m"].get<double>(), 0.01);
}
INSTANTIATE_TEST_SUITE_P(By, HeldPose,
                         ::testing::Values("0.1, 0, 0", "0.1, 0.05, -0.1", "-0.05, -0.1, 0.05",
                                           "0.15, 0, 0.1"));

TEST(ArmAtRest, OfWhichNothingIsAskedDoesNotCreep) {
  const TemporaryFolder folder;
  summaryOf({"balance", {"duration_s=30", "requirements={}"}, 1, folder / "run"});
  runBallbot({"export", folder / "run", "--csv", folder / "csv"});
  std::istringstream rows(readFile(folder / "csv/truth.csv"));
  std::string row;
  std::getline(rows, row);
  double first[9] = {}, x[9] = {};
  for (bool begun = false; std::getline(rows, row); begun = true) {
    ASSERT_EQ(std::sscanf(row.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &x[0], &x[1], &x[2],
                          &x[3], &x[4], &x[5], &x[6], &x[7], &x[8]),
              9);
    if (!begun) std::copy(std::begin(x), std::end(x), std::begin(first));
  }
  for (int i = 6; i < 9; ++i) EXPECT_NEAR(x[i], first[i], 0.06) << "arm joint " << i - 5;
}

}  // namespace
}  // namespace ballbot
