// Floors that hold the ball's spin badly, or not everywhere alike, and what is asked of a robot
// there.
#include <cmath>
#include <cstdio>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/tools/scenario_run.hpp"

namespace ballbot {
namespace {

nlohmann::json runOnFloor(const std::string& scenario, double held, int seed,
                          std::vector<std::string> changes, const std::string& out = "") {
  const std::string floor = fmt::format("plant.spin_friction.torque_Nm={}", held);
  changes.insert(changes.begin(), {"requirements={}", floor});
  return summaryOf({scenario, changes, seed, out});
}

struct Slippery {
  const char* name;
  const char* scenario;
  double held;  ///< [N m]
  std::vector<std::string> changes;
  double tilt_below_deg;
};

void PrintTo(const Slippery& floor, std::ostream* out) { *out << floor.name; }

class SlipperyFloor : public ::testing::TestWithParam<Slippery> {};

TEST_P(SlipperyFloor, DoesNotFellTheRobot) {
  const Slippery& floor = GetParam();
  const auto json = runOnFloor(floor.scenario, floor.held, 4, floor.changes);
  EXPECT_FALSE(json["fell"].get<bool>());
  EXPECT_LT(json["largest_tilt_deg"].get<double>(), floor.tilt_below_deg);
  EXPECT_LT(json["metrics"]["largest_tilt_error_deg"].get<double>(), 0.5);
}

std::string yaw(const char* moves) {
  return fmt::format("controller.mpc.tasks.yaw.reference={{moves: [{}]}}", moves);
}
std::string pushed(const char* force_N, double x = 0) {
  return fmt::format(
      "{{body: base, point_m: [{}, 0, 0.35], force_N: [{}], start_s: 3, duration_s: 0.5}}", x,
      force_N);
}
std::string slipping(double seconds) {
  return fmt::format(
      "plant.faults=[{{kind: wheel_slip, joint: wheel_1, traction_Nm: 0.2, start_s: 3, duration_s: "
      "{}}}]",
      seconds);
}

INSTANTIATE_TEST_SUITE_P(
    At, SlipperyFloor,
    ::testing::Values(
        Slippery{"YawBy90", "balance", 0.4, {"duration_s=8", yaw("{at_s: 2, by: 1.5708}")}, 5},
        Slippery{"YawBy180Across180",
                 "balance",
                 0.4,
                 {"duration_s=12", "initial.yaw_deg=100", yaw("{at_s: 2, by: 3.1416}")},
                 5},
        Slippery{"Twist",
                 "balance",
                 0.8,
                 {"duration_s=8", "environment.pushes=[" + pushed("0, 3, 0", 0.5) + ", " +
                                      pushed("0, -3, 0", -0.5) + "]"},
                 6},
        Slippery{"WheelLetsGoDuringPush",
                 "balance",
                 0.8,
                 {"duration_s=8", "environment.pushes=[" + pushed("0, 20, 0") + "]", slipping(0.5)},
                 16},
        Slippery{"WheelLetsGoForLong",
                 "balance",
                 0.8,
                 {"duration_s=8", "environment.pushes=[" + pushed("0, 20, 0") + "]", slipping(3)},
                 16},
        Slippery{"DriveDiesAtRest",
                 "balance",
                 0.8,
                 {"duration_s=10",
                  "plant.faults=[{kind: drive_dead, joint: wheel_2, start_s: 3, duration_s: 20}]"},
                 5},
        Slippery{"DoorAsHeld", "door_10N", 0.4, {}, 12},
        Slippery{"Compliant",
                 "balance",
                 0.4,
                 {"duration_s=4", "plant.fidelity.contact=compliant", yaw("{at_s: 2, by: 0.314}")},
                 5},
        Slippery{"OtherEstimator",
                 "balance",
                 0.4,
                 {"duration_s=8", "estimator={kind: complementary}", yaw("{at_s: 2, by: 0.314}")},
                 5}),
    [](const auto& test) { return std::string(test.param.name); });

/// What was learned of the floor at the end of a run, as the log has it.
double learned(const std::string& run) {
  const TemporaryFolder folder;
  runBallbot({"export", run, "--csv", folder / "csv"});
  const std::string text = readFile(folder / "csv/estimate.csv");
  std::istringstream names(text.substr(0, text.find('\n')));
  std::istringstream values(text.substr(text.rfind('\n', text.size() - 2) + 1));
  for (std::string name, value;
       std::getline(names, name, ',') && std::getline(values, value, ',');) {
    if (name.rfind("floor_spin_torque_held", 0) == 0) return std::stod(value);
  }
  ADD_FAILURE() << "no column of what the floor holds";
  return 0;
}

// The robot is on good floor, rolls onto a patch that holds little, turns there, and comes back.
TEST(FloorPatch, IsLearnedWhereTheRobotTurns) {
  const TemporaryFolder folder;
  const auto json = runOnFloor(
      "balance", 1.5, 4,
      {"duration_s=20",
       "plant.spin_friction.patches=[{center_m: [1, 0], radius_m: 0.4, torque_Nm: 0.2}]",
       "controller.floor.spin_torque_Nm=1",
       "controller.mpc.tasks.ball_position.reference={moves: [{at_s: 2, by: [1, 0], over_s: 4}]}",
       yaw("{at_s: 9, by: 1.5}, {at_s: 14, by: -1.5}")},
      folder / "run");
  EXPECT_FALSE(json["fell"].get<bool>());
  EXPECT_GT(json["metrics"]["largest_spin_rate_rad_per_s"].get<double>(), 0.2) << "it was believed";
  EXPECT_NEAR(learned(folder / "run"), 0.2, 0.1);
}

// With weights for nothing else and the arm held, ten to ninety percent of a quarter turn take
// 0.83 times what the fastest way there is takes: full torque one way, then the other.
TEST(FloorPatch, AQuarterTurnIsNearlyAsFastAsTheFloorAllows) {
  const TemporaryFolder folder;
  constexpr double kTurn = 1.5708, kHeld = 0.4, kInertia = 0.234;  // [rad], [N m], [kg m^2]
  const auto json = runOnFloor(
      "balance", kHeld, 4,
      {"duration_s=6", "controller.floor.learned=false", "controller.floor.command_share=0.95",
       "controller.mpc.constraints.spin_torque_limit.share_of_limit=0.9",
       "controller.mpc.command_limits={angle_step_rad: 5, angle_speed_rad_per_s: 5}",
       "controller.mpc.tasks.yaw.weight=600", "controller.mpc.tasks.base_rate.weight=[4, 4, 0.5]",
       "controller.mpc.tasks.arm_position={weight: 3000}",
       "controller.mpc.tasks.ee_orientation.weight=0", yaw("{at_s: 2, by: 1.5708}")},
      folder / "run");
  EXPECT_FALSE(json["fell"].get<bool>());
  runBallbot({"export", folder / "run", "--csv", folder / "csv"});
  std::istringstream rows(readFile(folder / "csv/truth.csv"));
  std::string row;
  std::getline(rows, row);
  double begin = 0, end = 0;
  while (end == 0 && std::getline(rows, row)) {
    double t = 0, x = 0, y = 0, angle = 0;
    ASSERT_EQ(std::sscanf(row.c_str(), "%lf,%lf,%lf,%lf", &t, &x, &y, &angle), 4);
    if (begin == 0 && angle > 0.1 * kTurn) begin = t;
    if (angle > 0.9 * kTurn) end = t;
  }
  const double half = std::sqrt(kTurn * kInertia / kHeld);
  const double fastest = 2 * half * (1 - std::sqrt(0.2));
  EXPECT_GT(fastest / (end - begin), 0.8);
  EXPECT_LT(fastest / (end - begin), 1.0);
}

}  // namespace
}  // namespace ballbot
