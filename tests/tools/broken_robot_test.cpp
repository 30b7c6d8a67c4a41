// A robot of which something is broken, and one that is only slow.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/tools/scenario_run.hpp"

namespace ballbot {
namespace {

nlohmann::json pushed(std::vector<std::string> changes) {
  changes.insert(changes.end(), {"requirements={}", "plant.fidelity.multibody=reduced_wheels"});
  return summaryOf({"push", changes});
}

std::string dead(int wheel, double seconds) {
  return fmt::format(
      "plant.faults=[{{kind: drive_dead, joint: wheel_{}, start_s: 2.2, duration_s: {}}}]", wheel,
      seconds);
}

class DeadDrive : public ::testing::TestWithParam<int> {};

TEST_P(DeadDrive, InAPushIsSurvived) {
  const auto json = pushed({"duration_s=8", dead(GetParam(), 20)});
  EXPECT_FALSE(json["fell"].get<bool>());
  EXPECT_LT(json["largest_tilt_deg"].get<double>(), 15);
}
INSTANTIATE_TEST_SUITE_P(Of, DeadDrive, ::testing::Values(1, 2, 3));

TEST(DrivePausing, IsCountedOnAgain) {
  const auto json = pushed({"duration_s=12", dead(2, 0.12)});
  EXPECT_LT(json["metrics"]["largest_ball_excursion_m"].get<double>(), 0.3);
  EXPECT_LT(json["metrics"]["final_tilt_deg"].get<double>(), 2.5);
}

// Little arrives of what is asked, at every wheel: no drive is to blame.
class SlowDrives : public ::testing::TestWithParam<std::string> {};

TEST_P(SlowDrives, AreNotDead) {
  const auto json = pushed({"duration_s=8", GetParam()});
  EXPECT_FALSE(json["fell"].get<bool>());
  EXPECT_EQ(json["metrics"]["drives_dead"].get<double>(), 0);
}
INSTANTIATE_TEST_SUITE_P(With, SlowDrives,
                         ::testing::Values("robot.actuators.wheel.torque_bandwidth_Hz=15",
                                           "robot.actuators.wheel.peak_torque_Nm=3",
                                           "robot.actuators.wheel.viscous_friction_Nms_per_rad=3"));

// Two wheels and a gyroscope fit a ball that spins as well as one that rolls another way.
class StuckEncoder : public ::testing::TestWithParam<int> {};

TEST_P(StuckEncoder, ForLongLosesLittle) {
  const auto json =
      pushed({"duration_s=10",
              fmt::format("plant.faults=[{{kind: encoder_stuck, joint: wheel_{}, start_s: 1, "
                          "duration_s: 20}}]",
                          GetParam())});
  EXPECT_FALSE(json["fell"].get<bool>());
  EXPECT_LT(json["metrics"]["position_error_m"].get<double>(), 0.05);
}
INSTANTIATE_TEST_SUITE_P(Of, StuckEncoder, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace ballbot
