#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <unistd.h>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

std::string studyPath(const std::string& name) {
  return std::string(BALLBOT_SOURCE_DIR) + "/configs/studies/" + name + ".yaml";
}

// The smoke study in less than a tenth of its simulated time.
const std::vector<std::string> kBrief = {"--quiet", "--json", "--set", "duration_s=0.1"};

nlohmann::json summaryOf(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "study");
  const Finished run = runBallbot(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << run.err;
  return json.is_discarded() ? nlohmann::json::object() : json;
}

std::vector<std::string> brief(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), kBrief.begin(), kBrief.end());
  return arguments;
}

TEST(Study, SmokePassesAndIsTheSameForOneJobAndTwo) {
  const TemporaryFolder folder;
  const auto one =
      summaryOf({studyPath("smoke"), "--jobs", "1", "--quiet", "--json", "--out", folder / "one"});
  const auto two =
      summaryOf({studyPath("smoke"), "--jobs", "2", "--quiet", "--json", "--out", folder / "two"});
  EXPECT_EQ(one.value("cases", 0), 8);
  EXPECT_EQ(one.value("failed", -1), 0);
  EXPECT_EQ(one["outcomes"].value("passed", 0), 8);
  EXPECT_EQ(one["table_digest"], two["table_digest"]);
  for (const char* file :
       {"/table.csv", "/table.h5", "/summary.json", "/report.html", "/commands.sh"}) {
    EXPECT_TRUE(readFile((folder / "one") + file) == readFile((folder / "two") + file))
        << file << " differs";
  }
  EXPECT_FALSE(fs::exists(folder / "one/cases")) << "run folders were not to be kept";
}

TEST(Study, ACaseAloneDoesWhatItDidInTheStudy) {
  const TemporaryFolder folder;
  summaryOf(brief({studyPath("smoke"), "--out", folder / "study"}));
  const std::string table = readFile(folder / "study/table.csv");
  std::ifstream commands(folder / "study/commands.sh");
  std::string line, command;
  while (std::getline(commands, line)) {
    if (line.rfind("ballbot ", 0) == 0) command = line;  // the last one
  }
  const std::string shell = "cd '" BALLBOT_SOURCE_DIR "' && '" BALLBOT_BIN_DIR "/" +
                            command.substr(0, 7) + "'" + command.substr(7) +
                            " --quiet --json --no-report --out '" + (folder / "alone") + "' > '" +
                            (folder / "alone.json") + "'";
  ASSERT_NE(std::system(shell.c_str()), -1);
  const auto alone = nlohmann::json::parse(readFile(folder / "alone.json"), nullptr, false);
  ASSERT_FALSE(alone.is_discarded()) << shell;
  EXPECT_THAT(table, HasSubstr(alone["trajectory_digest"].get<std::string>()));
}

TEST(Study, ACaseThatFallsIsAResultWithItsReason) {
  const TemporaryFolder folder;
  const auto json =
      summaryOf({studyPath("smoke"), "--quiet", "--json", "--set", "controller.kind=lqr", "--set",
                 "controller.tracker.wheel_torque_limit_Nm=0.01", "--out", folder / "study"});
  EXPECT_EQ(json["outcomes"].value("fell", 0), 8);
  EXPECT_EQ(json.value("failed", -1), 0) << "a fall is a finding, not a failure of the study";
  EXPECT_THAT(readFile(folder / "study/table.csv"), HasSubstr(",fell,fell at "));
  EXPECT_THAT(readFile(folder / "study/report.html"), HasSubstr("First to fall"));
}

TEST(Study, ACaseThatHangsIsAResultWithItsReasonAndCanBeTriedAgain) {
  const TemporaryFolder folder;
  const std::string study = folder / "slow.yaml";
  std::string text = readFile(studyPath("smoke"));
  text.replace(text.find("timeout_s: 120"), 14, "timeout_s: 0.2");
  text.replace(text.find("../scenarios"), 12, BALLBOT_SOURCE_DIR "/configs/scenarios");
  std::ofstream(study) << text;
  const Finished run = runBallbot({"study", study, "--quiet", "--json", "--jobs", "2", "--set",
                                   "duration_s=1000", "--out", folder / "study"});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  EXPECT_EQ(json["outcomes"].value("timed_out", 0), 8);
  EXPECT_EQ(json.value("failed", 0), 8);
  EXPECT_THAT(readFile(folder / "study/table.csv"), HasSubstr("timed_out,no end within 0.2 s"));
  // A resumed study keeps them; with --retry it forgets them first.
  EXPECT_EQ(runBallbot({"study", study, "--quiet", "--json", "--set", "duration_s=1000", "--resume",
                        "--retry", "--jobs", "2", "--out", folder / "study"})
                .exit_code,
            1);
}

TEST(Study, WhatIsWrongWithAnyCaseIsSaidBeforeOneRuns) {
  const TemporaryFolder folder;
  const Finished run = runBallbot({"study", studyPath("smoke"), "--out", folder / "study", "--set",
                                   "plant.transport_delay_ticks=-3", "--quiet"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("smoke: 4 of 4 configurations cannot run; nothing was started:"));
  EXPECT_THAT(run.err, HasSubstr("--set plant.transport_delay_ticks=-3: transport_delay_ticks is "
                                 "-3, must be between 0 and 1000"));
  EXPECT_THAT(run.err, HasSubstr("in: bandwidth 20 Hz, shaping none, seed 1 and 3 more"));
  EXPECT_FALSE(fs::exists(folder / "study"));
  EXPECT_THAT(runBallbot({"study", "configs"}).err, HasSubstr("configs"));
  EXPECT_EQ(runBallbot({"study", "no_such.yaml"}).exit_code, 2);
}

/// A study of the balancing robot, with `more` lines.
std::string writeStudy(const std::string& path, const std::string& more) {
  std::ofstream(path) << "name: tried\nscenario: " BALLBOT_SOURCE_DIR
                         "/configs/scenarios/balance.yaml\n"
                      << more;
  return path;
}

TEST(Study, MetricsThatNoRunHasAreNamedBeforeOneRuns) {
  const TemporaryFolder folder;
  const std::string typo =
      writeStudy(folder / "typo.yaml", "report: {metrics: [largest_tlit_deg]}\n");
  Finished run = runBallbot({"study", typo, "--out", folder / "study", "--quiet"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err,
              HasSubstr("report.metrics names 'largest_tlit_deg', which no run has; there are: "));
  EXPECT_THAT(run.err, HasSubstr("largest_tilt_deg"));
  const std::string clash = writeStudy(
      folder / "clash.yaml", "axes: [{name: plans, paths: duration_s, values: [1, 2]}]\n");
  run = runBallbot({"study", clash, "--out", folder / "study", "--quiet"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("an axis is called 'plans', as a metric of the runs"));
  EXPECT_FALSE(fs::exists(folder / "study"));
}

class ShippedStudy : public ::testing::TestWithParam<const char*> {};

// In a few control steps each: all of a study but the length of its runs.
TEST_P(ShippedStudy, RunsToItsEndAndLeavesAllItsFiles) {
  const TemporaryFolder folder;
  const std::string out = folder / "study";
  const Finished run = runBallbot({"study", studyPath(GetParam()), "--quiet", "--json", "--set",
                                   "duration_s=0.02", "--set", "environment={}", "--out", out});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* file : {"table.csv", "table.h5", "summary.json", "report.html", "commands.sh"}) {
    EXPECT_TRUE(fs::exists(out + "/" + file)) << file << " is missing";
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedStudy,
                         ::testing::Values("delay_margin", "fidelity_ladder", "gain_margin",
                                           "mpc_rate", "noise", "sea_bandwidth",
                                           "sea_stiffness_arm", "smoke"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Study, ResumingAsksForTheSameStudy) {
  const TemporaryFolder folder;
  const auto first = summaryOf(brief({studyPath("smoke"), "--out", folder / "study"}));
  const auto again = summaryOf(brief({studyPath("smoke"), "--resume", "--out", folder / "study"}));
  EXPECT_EQ(first["table_digest"], again["table_digest"]);
  const Finished other = runBallbot({"study", studyPath("smoke"), "--resume", "--quiet", "--set",
                                     "duration_s=0.2", "--out", folder / "study"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("was begun with another study or scenario"));
  const Finished twice =
      runBallbot({"study", studyPath("smoke"), "--quiet", "--out", folder / "study"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.err, HasSubstr("Nothing was overwritten"));
}

TEST(Study, BisectionFindsAValueBetweenTheEnds) {
  const TemporaryFolder folder;
  // Passing is made a plain matter of the starting angle: the limit on tilt is 8 degrees, the
  // stand holds the robot at its start, so that the boundary is known beforehand.
  const Finished run = runBallbot(
      {"study", studyPath("smoke"), "--quiet", "--json", "--find", "boundary=initial.pitch_deg",
       "--between", "1", "30", "--set", "duration_s=0.5", "--set", "initial.release_s=0.45",
       "--set", "requirements={largest_tilt_deg: {below: 8}}", "--out", folder / "study"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  ASSERT_EQ(json["boundaries"].size(), 4u) << "one per bandwidth and shaping";
  for (const auto& b : json["boundaries"]) {
    EXPECT_TRUE(b["found"].get<bool>());
    EXPECT_EQ(b["passes"], "below");
    EXPECT_NEAR(b["estimate"].get<double>(), 8, 0.5);
  }
}

}  // namespace
}  // namespace ballbot
