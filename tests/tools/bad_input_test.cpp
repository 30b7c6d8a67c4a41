#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

/// One bad way to call `run`, and the words that must be said about it.
struct BadInput {
  const char* name;
  std::vector<std::string> arguments;  ///< after `run balance`
  const char* words;
};

class BadScenario : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadScenario, IsRefusedInWordsBeforeAnythingIsLeftBehind) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {"run", scenarioPath("balance"), "--quiet", "--out",
                                        folder / "run"};
  for (const std::string& a : GetParam().arguments) arguments.push_back(a);
  const Finished run = runBallbot(arguments, 20);
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_THAT(run.err, HasSubstr(GetParam().words));
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1)
      << "one message, one line: " << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_FALSE(std::ifstream(folder / "run/scenario.yaml").good());
}

INSTANTIATE_TEST_SUITE_P(
    Run, BadScenario,
    ::testing::Values(
        BadInput{"UnknownKey", {"--set", "plant.actuatros=ideal"}, "unknown key 'actuatros'"},
        BadInput{"UnknownSection", {"--set", "plnat.x=1"}, "unknown key 'plnat'"},
        BadInput{"WrongType", {"--set", "duration_s=long"}, "duration_s is long, must be a number"},
        BadInput{"OutOfRange", {"--set", "duration_s=-1"}, "duration_s is -1, must be between"},
        BadInput{"WrongChoice",
                 {"--set", "plant.fidelity.actuators=magic"},
                 "must be one of: ideal, series_elastic"},
        BadInput{
            "Unschedulable", {"--set", "rates.tracker_period_us=333"}, "Nearest: 300 us, 400 us"},
        BadInput{"PlansTooOldToAct",
                 {"--set", "rates.planner_period_us=200000"},
                 "fallback_after_ms is 100, must be at least 212"},
        BadInput{"ArmBeyondItsStop",
                 {"--set",
                  "controller.mpc.tasks.arm_position={weight: 5, reference: {moves: [{at_s: 2, by: "
                  "[0, 0, 2]}]}}"},
                 "asks at 2 s for 4.171 rad of joint 3 ('arm_3'), must be between 0 and 2.6"},
        BadInput{"TorqueLimitBelowTheLoad",
                 {"--set", "robot.arm_torque_limit_Nm=1"},
                 "to stand still with the arm at"},
        BadInput{"TorqueForNothing",
                 {"--set", "controller.mpc.tasks.arm_torque.weight=0"},
                 "weight is 0, must be more than 0"},
        BadInput{
            "UnknownMetric", {"--set", "requirements.beauty.above=3"}, "unknown metric 'beauty'"},
        BadInput{"NoLimit", {"--set", "requirements.largest_tilt_deg={}"}, "has no limit"},
        BadInput{"NoEquals", {"--set", "duration_s"}, "write path=value"},
        BadInput{"MissingUrdf", {"--set", "robot.urdf=nowhere.urdf"}, "nowhere.urdf"},
        BadInput{"NoGravity",
                 {"--set", "robot.gravity_m_per_s2=0"},
                 "gravity_m_per_s2 is 0, must be between"},
        BadInput{"CentreOfMassFarOff",
                 {"--set", "robot.nominal_arm_rad=[0,2,0]", "--set", "robot.payload_mass_kg=40"},
                 "no equilibrium within 30 degrees for the arm at (0.000, 2.000, 0.000) rad"},
        BadInput{"BlindWeights",
                 {"--set", "controller.lqr.weights={ball_position: 1e-300}"},
                 "kind: no such law balances this robot: Riccati"},
        BadInput{"UnknownEstimator", {"--set", "estimator.kind=oracle"}, "kind is 'oracle'"},
        BadInput{"UnknownLaw", {"--set", "controller.kind=magic"}, "kind is 'magic'"}),
    [](const auto& test) { return test.param.name; });

TEST(BadFiles, AMissingScenarioIsNamed) {
  const Finished run = runBallbot({"run", "/nowhere/x.yaml"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("/nowhere/x.yaml: cannot be read"));
}

TEST(BadFiles, ADeviceThatNeverEndsIsNoConfiguration) {
  const Finished run = runBallbot({"run", "/dev/zero", "--quiet"}, 20);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("/dev/zero: is longer than 16 MiB"));
}

TEST(BadFiles, AVerbThatIsNoneIsNamedWithTheNearest) {
  const Finished run = runBallbot({"estimat", "x.yaml"}, 20);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("'estimat' is none of its verbs; did you mean 'estimate'?"));
}

TEST(BadFiles, ARequirementOnAMisspeltMetricNamesTheNearest) {
  const TemporaryFolder folder;
  const Finished run =
      runBallbot({"run", scenarioPath("balance"), "--quiet", "--out", folder / "run", "--set",
                  "requirements={largest_tilt_dge: {below: 1}}"},
                 20);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("did you mean 'largest_tilt_deg'?"));
}

TEST(BadFiles, AnErrorNamesFileLineAndColumn) {
  const TemporaryFolder folder;
  std::string text = readFile(scenarioPath("balance"));
  const std::string configs = std::string(BALLBOT_SOURCE_DIR) + "/configs/";
  for (std::size_t at; (at = text.find("../")) != std::string::npos;) text.replace(at, 3, configs);
  // Absolute includes: std::filesystem's operator/ lets an absolute path win.
  text.replace(text.find("pitch_deg: 3"), 12, "pitch_deg: steep");
  std::ofstream(folder / "bad.yaml") << text;
  const Finished run =
      runBallbot({"run", folder / "bad.yaml", "--quiet", "--out", folder / "run"}, 20);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, ::testing::ContainsRegex(
                           "bad\\.yaml:[0-9]+:14: pitch_deg is steep, must be a number"));
}

TEST(BadFiles, LimitsThatMayBeDegreesDeserveAWordAndTheRunGoesOn) {
  const TemporaryFolder folder;
  std::string text = readFile(std::string(BALLBOT_SOURCE_DIR) + "/configs/robots/ballbot.urdf");
  const std::string limits = "lower=\"-3.1\" upper=\"3.1\"";
  ASSERT_NE(text.find(limits), std::string::npos);
  text.replace(text.find(limits), limits.size(), "lower=\"-177.6\" upper=\"177.6\"");
  std::ofstream(folder / "degrees.urdf") << text;
  const Finished run =
      runBallbot({"run", scenarioPath("balance"), "--in-process", "--quiet", "--no-report", "--set",
                  "requirements={}", "--set", "duration_s=0.1", "--set",
                  "robot.urdf=" + (folder / "degrees.urdf"), "--out", folder / "run"},
                 60);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err,
              HasSubstr("degrees.urdf:275: joint 'arm_1_joint' has a limit at -177.6 rad"));
}

TEST(BadFiles, AFilledFolderIsNotOverwritten) {
  const TemporaryFolder folder;
  std::ofstream(folder / "precious.txt") << "data";
  const Finished run = runBallbot({"run", scenarioPath("balance"), "--out", folder / "."});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("Nothing was overwritten"));
  EXPECT_EQ(readFile(folder / "precious.txt"), "data");
}

TEST(BadFiles, AFolderThatIsNoRunIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(runBallbot({"check", folder / "."}).err, HasSubstr("not the folder of a run"));
  EXPECT_THAT(runBallbot({"compare", folder / "x", folder / "."}).err, HasSubstr("no such folder"));
  const Finished nothing = runBallbot({"export", folder / "."});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("--csv FOLDER"));
}

TEST(Help, EveryVerbHasExamplesAndExitCodes) {
  for (const char* verb :
       {"run", "check", "compare", "export", "plant", "controller", "relay", "doctor"}) {
    const Finished help = runBallbot({verb, "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, HasSubstr(std::string("ballbot ") + verb)) << verb << " has no example";
  }
  EXPECT_EQ(runBallbot({"dance"}).exit_code, 2);
  EXPECT_THAT(runBallbot({"--version"}).out, HasSubstr("ballbot 0."));
}

TEST(Doctor, SaysWhatItFoundAsJson) {
  const Finished doctor = runBallbot({"doctor", "--json"});
  const auto json = nlohmann::json::parse(doctor.out);
  EXPECT_EQ(json["healthy"].get<bool>(), doctor.exit_code == 0);
  EXPECT_EQ(json["checks"].size(), 6u);
  for (const auto& check : json["checks"]) {
    EXPECT_EQ(check["level"] == "ok", check["mend"] == "")
        << "a fault comes with its mend: " << check;
  }
}

TEST(Doctor, MeasuresWhatMakesARealTimeLoopLate) {
  const Finished late = runBallbot({"doctor", "--real-time", "--seconds", "0.05", "--json"});
  const auto rows = nlohmann::json::parse(late.out);
  EXPECT_EQ(late.exit_code, rows["ready"].get<bool>() ? 0 : 1) << late.err;
  EXPECT_EQ(rows["checks"].size(), 11U);
  for (const auto& row : rows["checks"]) EXPECT_NE(row["worth"], "") << row["name"];
  EXPECT_GT(rows["floor"]["ordinary"]["count"].get<int>(), 0);
  EXPECT_EQ(runBallbot({"doctor", "--real-time", "--core", "4095"}).exit_code, 2);
}

}  // namespace
}  // namespace ballbot
