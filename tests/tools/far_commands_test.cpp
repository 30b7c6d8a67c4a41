#include <ostream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

const std::string kTasks = "controller.mpc.tasks.";

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
  const TemporaryFolder folder;
  const Finished run = runBallbot(
      {"run", scenarioPath(far.scenario), "--seed", "3", "--in-process", "--quiet", "--no-report",
       "--json", "--out", folder / "run", "--set", "duration_s=9", "--set", "requirements={}",
       "--set", "plant.fidelity.multibody=reduced_wheels", "--set",
       kTasks + far.task + ".reference=" + far.reference});
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << run.err;
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
        FarCommand{"EeStepBallHeld", "whole_body_sequence", "ee_position",
                   "{moves: [{at_s: 2, by: [5, 0, 0]}]}"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace ballbot
