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
  const Finished run = runBallbot({"reproduce", "--only", "door_7N", "--scenarios", kScenarios, "--out", folder / "out"}, 20);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("--only door_7N: no such experiment; there are: ee_pose_tracking, disturbance_ball"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

/// Short versions of two of them: what is written and said, not whether the paper is met.
TEST(Reproduce, WritesOnePageWithPicturesVerdictsAndLinks) {
  const TemporaryFolder folder;
  const Finished run = runBallbot({"reproduce", "--only", "disturbance_ball", "--only", "disturbance_ee", "--in-process",
                                   "--quiet", "--json", "--scenarios", kScenarios, "--out", folder / "out",
                                   "--set", "duration_s=3", "--set", "plant.fidelity.multibody=reduced_wheels"}, 300);
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

}  // namespace
}  // namespace ballbot
