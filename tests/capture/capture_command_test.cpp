#include <filesystem>
#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
namespace fs = std::filesystem;
using Json = nlohmann::json;

Json captured(std::vector<std::string> arguments) {
  std::vector<std::string> whole = {"capture", scenarioPath("push"), "--json", "--quiet"};
  whole.insert(whole.end(), arguments.begin(), arguments.end());
  const Finished run = runBallbot(whole, 600);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const Json json = Json::parse(run.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << run.out;
  return json;
}

double boundAlongX(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--bound-only", "--directions", "1"});
  const Json json = captured(arguments);
  EXPECT_EQ(json["pushes"].size(), 1u);
  return json["pushes"][0].value("bound_known_N", 0.0);
}

/// The force that docs/capture.md says is survived in a direction, in finer steps and with more
/// seeds [N].
double survivedOnThePage(int direction_deg) {
  const std::string page = readFile(BALLBOT_SOURCE_DIR "/docs/capture.md");
  std::smatch row;
  EXPECT_TRUE(
      std::regex_search(page, row, std::regex(fmt::format("\\n\\| {} \\| (\\d+)", direction_deg))));
  return row.empty() ? 0 : std::stod(row[1]);
}

TEST(Capture, ItsBoundGoesByTheScenariosOwnLimits) {
  const double shipped = boundAlongX({});
  EXPECT_GT(boundAlongX({"--set", "robot.wheel_torque_limit_Nm=5"}), 1.02 * shipped);
  EXPECT_LT(boundAlongX({"--set", "controller.tracker.wheel_torque_limit_Nm=3"}), 0.98 * shipped);
  EXPECT_GT(boundAlongX({"--set", "plant.fidelity.speed_limit=false"}), 2 * shipped);
  // Heavier, and falling more slowly for standing taller.
  EXPECT_GT(boundAlongX({"--set", "robot.payload_mass_kg=1"}), 1.02 * shipped);
}

const std::vector<std::string> kBrief = {
    "--directions", "1",  "--seeds", "1",
    "--step-N",     "10", "--set",   "plant.fidelity.multibody=reduced_wheels"};

// The robot as simulated, noise and delays and all, against what no torque could do better. An LQR
// hardly moves its arm, which the bound takes for rigid; the MPC swings it and may get past.
TEST(Capture, TheBoundLiesAboveWhatARobotSurvivesThatKeepsItsArmStill) {
  const TemporaryFolder folder;
  std::vector<std::string> lqr = kBrief;
  lqr[5] = "20";
  for (const char* word : {"--set", "controller.kind=lqr", "--out"}) lqr.push_back(word);
  lqr.push_back(folder / "capture");
  const Json json = captured(lqr);
  const Json& push = json["pushes"][0];
  ASSERT_TRUE(push["survived_N"].is_number() && push["fallen_N"].is_number()) << push.dump();
  EXPECT_LT(push["survived_N"].get<double>(), push["bound_known_N"].get<double>());
  EXPECT_LT(push["bound_blind_N"].get<double>(), push["bound_known_N"].get<double>());
}

TEST(Capture, FindsWhatThePageSaysAndGoesOnWithWhatItHas) {
  const TemporaryFolder folder;
  std::vector<std::string> brief = kBrief;
  brief[1] = "4";
  brief.push_back("--out");
  brief.push_back(folder / "capture");
  const Json json = captured(brief);
  for (const Json& push : json["pushes"]) {
    ASSERT_TRUE(push["survived_N"].is_number() && push["fallen_N"].is_number()) << push.dump();
    const double survived = push["survived_N"];
    EXPECT_EQ(push["fallen_N"].get<double>(), survived + 10);
    const double on_page = survivedOnThePage(push["direction_deg"].get<int>());
    EXPECT_LE(survived, on_page + 2) << push.dump();  // of one seed; the page has more
    EXPECT_GE(survived + 10, on_page) << push.dump();
  }
  for (const char* file :
       {"capture.svg", "capture.json", "table.csv", "commands.sh", "study.yaml"}) {
    EXPECT_TRUE(fs::exists((folder / "capture/") + file)) << file;
  }
  EXPECT_THAT(readFile(folder / "capture/capture.svg"), StartsWith("<svg"));

  // All is recorded: to go on runs nothing again and finds the same.
  std::vector<std::string> again = brief;
  again.push_back("--resume");
  EXPECT_EQ(captured(again).dump(), json.dump());
  EXPECT_EQ(Json::parse(readFile(folder / "capture/timing.json")).value("cases_run", -1), 0);
}

struct BadCapture {
  const char* name;
  std::vector<std::string> arguments;  ///< after `capture push`
  const char* words;
};

class BadCaptures : public ::testing::TestWithParam<BadCapture> {};

TEST_P(BadCaptures, AreRefusedInWordsBeforeAnythingRuns) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {"capture", scenarioPath("push"), "--quiet", "--out",
                                        folder / "capture"};
  for (const std::string& a : GetParam().arguments) arguments.push_back(a);
  const Finished run = runBallbot(arguments, 60);
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_THAT(run.out + run.err, HasSubstr(GetParam().words));
  EXPECT_THAT(run.err, Not(HasSubstr("unexpected")));
  EXPECT_FALSE(fs::exists(folder / "capture"));
}

INSTANTIATE_TEST_SUITE_P(
    Capture, BadCaptures,
    ::testing::Values(
        BadCapture{"UnknownKey", {"--set", "plant.actuatros=ideal"}, "unknown key 'actuatros'"},
        BadCapture{"UnknownKeyBeside", {"--beside", "controller.knid=lqr"}, "unknown key 'knid'"},
        BadCapture{"NothingBeside", {"--beside", ";"}, "changes nothing: write path=value"},
        BadCapture{"TheSameTwiceBeside",
                   {"--beside", "controller.kind=lqr", "--beside", "controller.kind=lqr"},
                   "is given twice"},
        BadCapture{"TheSameDurationTwice",
                   {"--duration-s", "0.5", "--duration-s", "0.50"},
                   "--duration-s: 0.5 is given twice"},
        BadCapture{"ItsOwnPushes", {"--set", "environment.pushes=[]"}, "a capture decides itself"},
        BadCapture{"NoDirections", {"--directions", "0"}, "0"},
        BadCapture{"NoNumber", {"--step-N", "two"}, "'two' is not a number"},
        BadCapture{"PushedWhileHeld",
                   {"--set", "initial.release_s=4"},
                   "--start-s 3: a stand holds the robot until 4 s"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Capture, OfNoScenarioIsRefused) {
  EXPECT_EQ(runBallbot({"capture", "no_such.yaml", "--bound-only"}).exit_code, 2);
  EXPECT_EQ(runBallbot({"capture", "configs", "--bound-only"}).exit_code, 2);
}

}  // namespace
}  // namespace ballbot
