#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// Every sort of fault within a short while.
const char* const kFaults =
    "plant.faults=[{kind: imu_gap, start_s: 1.2, duration_s: 0.05},"
    "{kind: spikes, signal: gyro, start_s: 0.8, duration_s: 2, share: 0.05},"
    "{kind: encoder_stuck, joint: wheel_2, start_s: 0.9, duration_s: 0.4},"
    "{kind: wheel_slip, joint: wheel_1, start_s: 0.7, duration_s: 0.1, traction_Nm: 0.05}]";

/// So that there is a way on which to drift.
const char* const kPush =
    "environment={pushes: [{body: base, point_m: [0, 0, 0.3], force_N: [0, 20, 0], start_s: 0.6, "
    "duration_s: 0.4}]}";

json summaryOf(const std::string& run) { return json::parse(readFile(run + "/summary.json")); }

json runScenario(const std::string& out, std::vector<std::string> settings) {
  std::vector<std::string> arguments{
      "run", scenarioPath("balance"), "--quiet", "--no-report", "--in-process", "--out", out};
  settings.push_back("requirements={}");
  for (const std::string& setting : settings) {
    arguments.push_back("--set");
    arguments.push_back(setting);
  }
  const Finished run = runBallbot(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  return summaryOf(out);
}

json estimate(const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"estimate", "--json"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Finished run = runBallbot(all);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return json::parse(run.out, nullptr, false);
}

TEST(Estimate, IsThatOfTheRunBitForBitAlsoUnderFaults) {
  const TemporaryFolder folder;
  const json summary = runScenario(folder / "run", {"duration_s=2", kFaults, kPush});
  const json offline = estimate({folder / "run"});
  EXPECT_TRUE(offline["identical_to_online"].get<bool>()) << offline.dump(2);
  EXPECT_EQ(offline["compared_with_online"], offline["estimates"]);
  EXPECT_EQ(offline["estimates"].get<int>(), 801);
  EXPECT_EQ(offline["rejected"], summary["rejected"]);
  EXPECT_GT(offline["rejected"]["imu_missing"].get<int>(), 15);
  for (const char* metric : {"tilt_rms_deg", "velocity_rms_m_per_s", "position_drift_percent",
                             "yaw_error_deg", "nees_mean", "nis_mean"}) {
    EXPECT_TRUE(offline[metric].is_number()) << metric;
    EXPECT_EQ(offline[metric], summary["metrics"][metric]) << metric;
  }
  for (const json& file : offline["files"]) {
    EXPECT_GT(std::filesystem::file_size(file.get<std::string>()), 100u) << file;
  }
  EXPECT_THAT(readFile(folder / "run/estimate/estimation_error.csv"), HasSubstr("tilt_x"));
}

TEST(Estimate, TriesAnotherTuningOnTheSameSensors) {
  const TemporaryFolder folder;
  runScenario(folder / "run", {"duration_s=1.5"});
  const json same = estimate({folder / "run", "--no-report"});
  const json bold = estimate({folder / "run", "--no-report", "--out", folder / "bold", "--set",
                              "estimator.noise.wheel_increment_rad=1e-4"});
  EXPECT_TRUE(same["identical_to_online"].get<bool>());
  EXPECT_FALSE(bold["identical_to_online"].get<bool>());
  // Apart from the first update after the release on.
  EXPECT_NEAR(bold["first_difference_s"].get<double>(), 0.5, 0.006);
  EXPECT_GT(bold["nis_mean"].get<double>(), 1.2 * same["nis_mean"].get<double>());
  const json other = estimate({folder / "run", "--no-report", "--out", folder / "other", "--set",
                               "estimator.kind=complementary"});
  EXPECT_TRUE(other["nees_mean"].is_null());  // keeps no account of its uncertainty
  EXPECT_TRUE(other["tilt_rms_deg"].is_number());
}

TEST(Estimate, ReadsALogAloneAlsoOneThatWasCutOff) {
  const TemporaryFolder folder;
  runScenario(folder / "run", {"duration_s=1"});
  const std::string log = readFile(folder / "run/run.lcmlog");
  std::ofstream(folder / "cut.lcmlog", std::ios::binary) << log.substr(0, log.size() * 8 / 10);
  const json cut = estimate({folder / "cut.lcmlog", "--scenario", folder / "run/scenario.yaml"});
  EXPECT_TRUE(cut["identical_to_online"].get<bool>());
  EXPECT_NEAR(cut["estimates"].get<int>(), 320, 20);
}

TEST(Estimate, SaysWhatItNeeds) {
  const TemporaryFolder folder;
  runScenario(folder / "run", {"duration_s=0.6", "recording={sensors_period_ms: -1}"});
  const Finished no_sensors = runBallbot({"estimate", folder / "run"});
  EXPECT_EQ(no_sensors.exit_code, 2);
  EXPECT_THAT(no_sensors.err, HasSubstr("holds no sensor frames"));
  const Finished no_scenario = runBallbot({"estimate", folder / "run/run.lcmlog"});
  EXPECT_EQ(no_scenario.exit_code, 2);
  EXPECT_THAT(no_scenario.err, HasSubstr("--scenario"));
}

TEST(Estimator, RecoversInTheLoopFromATiltTenDegreesWrong) {
  const TemporaryFolder folder;
  const json summary =
      runScenario(folder / "run", {"duration_s=5", "estimator.initial_tilt_error_deg=[7, -7]"});
  EXPECT_FALSE(summary["fell"].get<bool>());
  EXPECT_GT(summary["metrics"]["largest_tilt_error_deg"].get<double>(), 9);
  EXPECT_LT(summary["metrics"]["largest_tilt_deg"].get<double>(), 20);
  EXPECT_LT(summary["metrics"]["final_tilt_deg"].get<double>(), 2.5);
  EXPECT_LT(summary["metrics"]["final_ball_position_error_m"].get<double>(), 0.1);
  EXPECT_GE(summary["rejected"]["state_doubted"].get<int>(), 1);
}

TEST(Estimator, FindsItsPlaceInTheRoomByMotionCapture) {
  // It is placed 20 degrees off and learns so from the room.
  const TemporaryFolder folder;
  const json summary =
      runScenario(folder / "run", {"duration_s=4", "plant.motion_capture={}", "initial.yaw_deg=20",
                                   "estimator.external_pose={}", "estimator.initial.yaw_deg=30",
                                   "estimator.initial.position_m=0.1"});
  EXPECT_LT(summary["metrics"]["yaw_error_deg"].get<double>(), 1);
  EXPECT_LT(summary["metrics"]["position_error_m"].get<double>(), 5e-3);
  EXPECT_FALSE(summary["fell"].get<bool>());
}

TEST(Estimator, TheComplementaryOneStillBalances) {
  const TemporaryFolder folder;
  const Finished run = runBallbot({"run", scenarioPath("balance"), "--quiet", "--no-report",
                                   "--in-process", "--out", folder / "run", "--set",
                                   "estimator.kind=complementary", "--set", "duration_s=4"});
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
}

}  // namespace
}  // namespace ballbot
