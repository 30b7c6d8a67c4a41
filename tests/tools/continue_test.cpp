// Recorded runs that are continued from a moment of theirs.
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A short run of `balance` with the LQR in charge, which is quick.
void record(const std::string& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {
      "run",     scenarioPath("balance"), "--out", out,
      "--quiet", "--no-report",           "--set", "duration_s=1.2",
      "--set",   "controller.kind=lqr"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished run = runBallbot(arguments);
  ASSERT_LE(run.exit_code, 1) << run.err;
}

Finished continueFrom(const std::string& moment, const std::string& out,
                      const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"run", "--from",  moment,       "--out",
                                        out,   "--quiet", "--no-report"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return runBallbot(arguments);
}

/// Where two runs differ first; null if one is the end of the other.
nlohmann::json difference(const std::string& a, const std::string& b) {
  const Finished compared = runBallbot({"compare", a, b, "--json"});
  const auto json = nlohmann::json::parse(compared.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << compared.err;
  return json.is_discarded() || json["identical"] ? nlohmann::json() : json["first_difference"];
}

std::size_t checkpointCount(const std::string& run) {
  if (!fs::exists(run + "/checkpoints")) return 0;
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(run + "/checkpoints"), {}));
}

TEST(Continue, AnUnchangedRunGoesOnToTheBit) {
  const TemporaryFolder folder;
  record(folder / "kept", {"--set", "recording.checkpoint_period_s=0.5"});
  record(folder / "plain", {"--in-process"});
  EXPECT_EQ(checkpointCount(folder / "kept"), 2U);
  EXPECT_EQ(checkpointCount(folder / "plain"), 0U);
  EXPECT_TRUE(difference(folder / "kept", folder / "plain").is_null()) << "to keep changes nothing";
  // 0.8301 s is between two events: the run goes on from the one after.
  for (const char* run : {"kept", "plain"}) {
    const std::string tail = folder / (std::string(run) + "_tail");
    ASSERT_LE(continueFrom((folder / run) + "@0.8301s", tail).exit_code, 1);
    EXPECT_TRUE(difference(folder / run, tail).is_null()) << difference(folder / run, tail);
    const auto manifest = nlohmann::json::parse(readFile(tail + "/manifest.json"));
    EXPECT_NEAR(manifest["begins_at_s"].get<double>(), 0.8304, 1e-12);
  }
  // And once more, from the middle of a tail.
  ASSERT_LE(
      continueFrom((folder / "kept_tail") + "@1.1", folder / "end", {"--in-process"}).exit_code, 1);
  EXPECT_TRUE(difference(folder / "kept", folder / "end").is_null());
}

TEST(Continue, AnotherControllerOrParameterActsFromThatMomentOn) {
  const TemporaryFolder folder;
  record(folder / "run");
  int number = 0;
  for (const char* change :
       {"controller.kind=mpc", "controller.lqr.weights.wheel_torque=2.5",
        "environment.pushes=[{body: base, point_m: [0, 0, 0.3], force_N: [0, 20, 0], "
        "start_s: 0.8, duration_s: 0.2}]"}) {
    const std::string what_if = folder / ("what_if_" + std::to_string(++number));
    const Finished run = continueFrom((folder / "run") + "@0.8s", what_if, {"--set", change});
    ASSERT_LE(run.exit_code, 1) << run.err;
    EXPECT_NEAR(difference(folder / "run", what_if)["time_s"].get<double>(), 0.8, 0.02) << change;
    const Finished checked = runBallbot({"check", what_if, "--quiet", "--in-process"});
    EXPECT_EQ(checked.out, "identical\n") << checked.err;
  }
}

TEST(Continue, SaysWhatCannotBeContinued) {
  const TemporaryFolder folder;
  record(folder / "run", {"--in-process"});
  const auto words = [&](const std::string& moment, const std::vector<std::string>& more = {}) {
    const Finished run = continueFrom(moment, folder / "none", more);
    EXPECT_EQ(run.exit_code, 2) << moment;
    EXPECT_FALSE(fs::exists(folder / "none"));
    return run.err;
  };
  const std::string run = folder / "run";
  EXPECT_THAT(words(run), HasSubstr("must be a run folder and a time, e.g. runs/push-001@4.2s"));
  EXPECT_THAT(words(run + "@soon"), HasSubstr("must be a run folder and a time"));
  EXPECT_THAT(words(run + "@1.2s", {"--set", "duration_s=3"}),
              HasSubstr("ended at 1.2 s, so it cannot be continued from 1.2 s"));
  EXPECT_THAT(words(run + "@1s", {"--set", "duration_s=0.9"}),
              HasSubstr("but the run ends at 0.9 s"));
  EXPECT_THAT(words("nowhere@1s"), HasSubstr("nowhere: no such folder"));
  EXPECT_THAT(
      words(run + "@1s", {"--set", "plant.fidelity.actuators=ideal"}),
      HasSubstr("cannot be continued with these settings: saved plant state is of a plant"));
}

}  // namespace
}  // namespace ballbot
