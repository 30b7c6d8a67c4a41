#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string kScenarios = std::string(BALLBOT_SOURCE_DIR) + "/configs/scenarios";

TEST(Reproduce, RefusesAnExperimentItDoesNotKnowAndListsThoseItDoes) {
  const TemporaryFolder folder;
  const Finished run = runBallbot(
      {"reproduce", "--only", "door_7N", "--scenarios", kScenarios, "--out", folder / "out"}, 20);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(
      run.err,
      HasSubstr(
          "--only door_7N: no such experiment; there are: ee_pose_tracking, disturbance_ball"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

/// Short versions of two of them: what is written and said, not whether the paper is met.
TEST(Reproduce, WritesOnePageWithPicturesVerdictsAndLinks) {
  const TemporaryFolder folder;
  const Finished run = runBallbot(
      {"reproduce", "--only", "disturbance_ball", "--only", "disturbance_ee", "--in-process",
       "--quiet", "--json", "--scenarios", kScenarios, "--out", folder / "out", "--set",
       "duration_s=3", "--set", "plant.fidelity.multibody=reduced_wheels"},
      300);
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << run.err;
  EXPECT_EQ(run.exit_code, json["passed"].get<bool>() ? 0 : 1);
  ASSERT_EQ(json["experiments"].size(), 2u);
  EXPECT_EQ(json["experiments"][0]["scenario"], "disturbance_ball");
  EXPECT_TRUE(json["experiments"][1]["passed"].is_boolean());
  EXPECT_TRUE(json["experiments"][1]["metrics"]["largest_push_ee_excursion_m"].is_number());
  EXPECT_EQ(json["comparisons"].size(), 1u);
  const std::string page = readFile(json["page"].get<std::string>());
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_THAT(page, HasSubstr("href='disturbance_ee/report.html'"));
  EXPECT_TRUE(std::filesystem::exists((folder / "out") + "/disturbance_ee/report.html"));
  EXPECT_THAT(page, Not(HasSubstr("src=")));  // opens offline
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

/// Two seeds of one experiment, shortened: how many pass, and the spread of every number.
TEST(Reproduce, TellsHowManySeedsPassAndHowFarTheirNumbersSpread) {
  const TemporaryFolder folder;
  const Finished run = runBallbot({"reproduce",
                                   "--only",
                                   "disturbance_ball",
                                   "--seeds",
                                   "3",
                                   "--jobs",
                                   "2",
                                   "--in-process",
                                   "--quiet",
                                   "--json",
                                   "--scenarios",
                                   kScenarios,
                                   "--out",
                                   folder / "out",
                                   "--set",
                                   "duration_s=2",
                                   "--set",
                                   "plant.fidelity.multibody=reduced_wheels",
                                   "--set",
                                   "requirements={largest_tilt_deg: {below: 20}}"},
                                  300);
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << run.err;
  EXPECT_EQ(run.exit_code, 0) << run.out;
  const auto& experiment = json["experiments"][0];
  const auto& seeds = experiment["seeds"];
  EXPECT_EQ(seeds["count"], 3);
  EXPECT_EQ(seeds["passed"], 3);
  const auto& tilt = seeds["metrics"]["largest_tilt_deg"];
  EXPECT_EQ(tilt["count"], 3);
  EXPECT_LT(tilt["least"].get<double>(), tilt["median"].get<double>());
  EXPECT_LT(tilt["median"].get<double>(), tilt["largest"].get<double>());
  const double own = experiment["metrics"]["largest_tilt_deg"].get<double>();  // seed 1, among them
  EXPECT_GE(own, tilt["least"].get<double>());
  EXPECT_LE(own, tilt["largest"].get<double>());
  EXPECT_FALSE(std::filesystem::exists((folder / "out") + "/seeds"));
  EXPECT_THAT(readFile(json["page"].get<std::string>()), HasSubstr("Seeds 1 to 3: 3 of 3 passed"));
}

TEST(Reproduce, SaysWhichSeedsMissedWhatAndFails) {
  const TemporaryFolder folder;
  const Finished run =
      runBallbot({"reproduce", "--only", "disturbance_ball", "--seeds", "2", "--in-process",
                  "--quiet", "--scenarios", kScenarios, "--out", folder / "out", "--set",
                  "duration_s=1", "--set", "plant.fidelity.multibody=reduced_wheels", "--set",
                  "requirements={largest_tilt_deg: {below: 0.1}}"},
                 300);
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_THAT(run.out, HasSubstr("disturbance_ball, seeds 1 to 2: 0 passed"));
  EXPECT_THAT(run.out, HasSubstr("seed 2: largest_tilt_deg is "));
}

}  // namespace
}  // namespace ballbot
