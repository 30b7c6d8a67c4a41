#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

/// Every scenario that ships must pass its own requirements.
class ShippedScenario : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedScenario, PassesItsRequirements) {
  const TemporaryFolder folder;
  const Finished run = runBallbot(
      {"run", scenarioPath(GetParam()), "--quiet", "--json", "--out", folder / "run"}, 600);
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << run.err;
  EXPECT_TRUE(json["passed"].get<bool>());
  EXPECT_FALSE(json["fell"].get<bool>());
  EXPECT_EQ(json["trajectory_digest"].get<std::string>().size(), 32u);
  EXPECT_TRUE(json["final_ball_position_error_m"].is_number());
  EXPECT_TRUE(json["largest_tilt_deg"].is_number());
  // Nobody knows the truth about a robot on a bench, so its scenarios ask for nothing but the end.
  if (GetParam().rfind("bench_", 0) != 0) {
    EXPECT_GE(json["requirements"].size(), 3u);
  }
  EXPECT_TRUE(std::filesystem::exists((folder / "run") + "/report.html"));
}

std::vector<std::string> shippedScenarios() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(BALLBOT_SOURCE_DIR) +
                                                               "/configs/scenarios")) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Shipped, ShippedScenario, ::testing::ValuesIn(shippedScenarios()),
                         [](const auto& test) { return test.param; });

/// The balancing law without optimisation must hold what the planning one holds.
TEST(Scenarios, BalanceAndPushPassWithTheLqrAlone) {
  for (const char* name : {"balance", "push"}) {
    const TemporaryFolder folder;
    const Finished run = runBallbot({"run", scenarioPath(name), "--quiet", "--json", "--no-report",
                                     "--out", folder / "run", "--set", "controller.kind=lqr"});
    EXPECT_EQ(run.exit_code, 0) << name << run.out << run.err;
  }
}

/// In the program itself: there Simbody's library brings an old SUNDIALS along.
TEST(Scenarios, BalancePassesOnTheContinuousEngine) {
  const TemporaryFolder folder;
  const Finished run = runBallbot(
      {"run", scenarioPath("balance"), "--quiet", "--json", "--no-report", "--in-process", "--out",
       folder / "run", "--set", "controller.mpc.engine=continuous", "--set", "duration_s=5"},
      600);
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
}

// A door that flies open leaves nothing to push against. The plan that still counts on its force
// runs after it and falls; supervision drops the force.
TEST(Scenarios, AForceThatIsNotThereIsDroppedBeforeTheRobotFalls) {
  for (const bool supervised : {true, false}) {
    const TemporaryFolder folder;
    std::vector<std::string> words{"run",         scenarioPath("door_10N"),
                                   "--quiet",     "--json",
                                   "--no-report", "--in-process",
                                   "--out",       folder / "run",
                                   "--set",       "duration_s=9",
                                   "--set",       "environment.door.inertia_kgm2=0.3",
                                   "--set",       "environment.door.damping_Nms_per_rad=0.5",
                                   "--set",       "environment.door.friction_Nm=0"};
    if (!supervised) {
      words.push_back("--set");
      words.push_back(
          "controller.mpc.contact_supervision="
          "{lost_share: 0, approach_force_N: 100, approach_limit_s: 100}");
    }
    const Finished run = runBallbot(words);
    const auto json = nlohmann::json::parse(run.out, nullptr, false);
    ASSERT_FALSE(json.is_discarded()) << run.err;
    EXPECT_EQ(json["fell"].get<bool>(), !supervised);
    if (supervised) {
      EXPECT_LT(json["largest_tilt_deg"].get<double>(), 10);
    }
  }
}

TEST(Requirements, AMissedOneGivesExitCodeOne) {
  const TemporaryFolder folder;
  const Finished run =
      runBallbot({"run", scenarioPath("balance"), "--quiet", "--json", "--no-report",
                  "--in-process", "--out", folder / "run", "--set", "duration_s=1", "--set",
                  "requirements.largest_tilt_deg.below=0.1"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_FALSE(nlohmann::json::parse(run.out)["passed"].get<bool>());
}

TEST(Requirements, AFallEndsTheRunAndNeverPasses) {
  const TemporaryFolder folder;
  const Finished run = runBallbot({"run", scenarioPath("balance"), "--quiet", "--json",
                                   "--no-report", "--in-process", "--out", folder / "run", "--set",
                                   "requirements={}", "--set", "initial.pitch_deg=40"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_TRUE(json["fell"].get<bool>());
  EXPECT_LT(json["simulated_s"].get<double>(), 5);
}

}  // namespace
}  // namespace ballbot
