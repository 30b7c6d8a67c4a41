#include <cmath>
#include <ostream>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/random.hpp"
#include "tests/tools/scenario_run.hpp"

namespace ballbot {
namespace {

const std::string kTasks = "controller.mpc.tasks.";

nlohmann::json sent(const std::string& scenario, std::vector<std::string> changes, int seed) {
  changes.insert(changes.begin(), {"requirements={}", "plant.fidelity.multibody=reduced_wheels"});
  return summaryOf({scenario, changes, seed});
}

struct FarCommand {
  const char* name;
  const char* scenario;
  const char* task;
  const char* reference;
};

void PrintTo(const FarCommand& far, std::ostream* out) { *out << far.name; }

/// One thing asked for that is far beyond what the robot can do at once.
class FarCommands : public ::testing::TestWithParam<FarCommand> {};

TEST_P(FarCommands, AreApproachedAndDoNotFellTheRobot) {
  const FarCommand& far = GetParam();
  const auto json =
      sent(far.scenario, {"duration_s=9", kTasks + far.task + ".reference=" + far.reference}, 3);
  ASSERT_FALSE(json.is_null());
  EXPECT_FALSE(json["fell"].get<bool>());
  EXPECT_LT(json["largest_tilt_deg"].get<double>(), 20);
  EXPECT_EQ(json["metrics"]["plans_refused"].get<double>(), 0);
  EXPECT_GT(json["metrics"]["plans_with_cut_commands"].get<double>(), 0);
}

INSTANTIATE_TEST_SUITE_P(
    One, FarCommands,
    ::testing::Values(
        FarCommand{"BallStep", "balance", "ball_position", "{moves: [{at_s: 2, by: [5, 0]}]}"},
        FarCommand{"BallRamp", "balance", "ball_position",
                   "{moves: [{at_s: 2, by: [0, 10], over_s: 2}]}"},
        FarCommand{"TenTurns", "balance", "yaw", "{moves: [{at_s: 2, by: [62.8]}]}"},
        FarCommand{"EeTurns", "balance", "ee_orientation", "{moves: [{at_s: 2, by: [5, 5, 5]}]}"},
        FarCommand{"EeStep", "ee_pose_tracking", "ee_position",
                   "{moves: [{at_s: 2, by: [5, 0, 0]}]}"},
        FarCommand{"Push", "door_5N", "contact_force", "{moves: [{at_s: 2, by: [0, 0, 100]}]}"},
        FarCommand{"EeStepBallHeld", "whole_body_sequence", "ee_position",
                   "{moves: [{at_s: 2, by: [5, 0, 0]}]}"}),
    [](const auto& test) { return std::string(test.param.name); });

// Tasks on frames are commands like the end-effector's.
TEST(FarFrameCommands, AreApproachedAndDoNotFellTheRobot) {
  const char* const place = "{moves: [{at_s: 2, by: [100, 0, 0]}]}";
  const char* const turn = "{moves: [{at_s: 3, by: [30, 2, 2]}]}";
  for (const char* body : {"base", "arm_2"}) {
    const std::string frames = fmt::format(
        "frames=[{{name: one, body: {}, position: {{weight: 100, reference: {}}}, orientation: "
        "{{weight: [0, 0, 5], reference: {}}}}}]",
        body, place, turn);
    const auto json = sent("balance", {"duration_s=9", kTasks + frames}, 3);
    ASSERT_FALSE(json.is_null());
    EXPECT_FALSE(json["fell"].get<bool>()) << body;
    EXPECT_LT(json["largest_tilt_deg"].get<double>(), 20) << body;
    EXPECT_GT(json["metrics"]["plans_with_cut_commands"].get<double>(), 0) << body;
  }
}

/// What nobody sane asks for, repeatable by number: every task of the scenario is sent somewhere
/// six times in 20 s, up to 100 m or 100 rad away, at once or within seconds.
class AbsurdCommands {
 public:
  explicit AbsurdCommands(int number)
      : stream_(static_cast<std::uint64_t>(number), "absurd_commands") {}

  std::string moves(int dimension, double scale) {
    std::string text;
    for (int i = 0; i < 6; ++i) {
      std::vector<std::string> by;
      const double at = between(1.5, 18);
      for (int k = 0; k < dimension; ++k) by.push_back(fmt::format("{:.3f}", scale * distance()));
      const double over = between(0, 1) < 2.0 / 3 ? 0 : between(0.1, 4);
      text += fmt::format("{}{{at_s: {:.3f}, by: [{}], over_s: {:.2f}}}", i ? ", " : "", at,
                          fmt::join(by, ", "), over);
    }
    return "{moves: [" + text + "]}";
  }

 private:
  double between(double low, double high) {
    return low + (high - low) * stream_.uniforms(drawn_++, 0)[0];
  }
  double distance() {
    if (between(0, 1) < 0.3) return 0;
    const double sign = between(0, 1) < 0.5 ? -1 : 1;
    return sign * std::pow(10, between(-0.3, 2));
  }
  RandomStream stream_;
  std::uint64_t drawn_ = 0;
};

class ManyFarCommands : public ::testing::TestWithParam<int> {};

// Twelve runs of some twenty commands each.
TEST_P(ManyFarCommands, AtOnceOnAllTasksDoNotFellTheRobot) {
  const std::string scenario = std::vector<std::string>{
      "balance", "ee_pose_tracking", "whole_body_sequence", "circle"}[GetParam() % 4];
  AbsurdCommands absurd(GetParam());
  std::vector<std::string> changes = {"duration_s=20"};
  const auto send = [&](const char* task, int dimension, double scale) {
    changes.push_back(kTasks + task + ".reference=" + absurd.moves(dimension, scale));
  };
  if (scenario != "ee_pose_tracking") send("ball_position", 2, 1);  // there the ball is free
  if (scenario != "balance") send("ee_position", 3, 1);
  send("yaw", 1, 1);
  send("ee_orientation", 3, 0.5);
  const auto json = sent(scenario, changes, 1 + GetParam());
  ASSERT_FALSE(json.is_null());
  EXPECT_FALSE(json["fell"].get<bool>());
  EXPECT_LT(json["largest_tilt_deg"].get<double>(), 35);
  EXPECT_GT(json["metrics"]["plans_with_cut_commands"].get<double>(), 0);
  EXPECT_GT(json["metrics"]["least_arm_position_margin_rad"].get<double>(), -0.01);
}

INSTANTIATE_TEST_SUITE_P(Random, ManyFarCommands, ::testing::Range(0, 12));

}  // namespace
}  // namespace ballbot
