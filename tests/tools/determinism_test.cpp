#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <unistd.h>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::vector<std::string> kShort = {"--set", "duration_s=1.5", "--quiet", "--json",
                                         "--no-report"};

/// Digest of a short run of `balance`, which must come to its end.
std::string digestOf(const std::string& out, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"run", scenarioPath("balance"), "--out", out};
  arguments.insert(arguments.end(), kShort.begin(), kShort.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished run = runBallbot(arguments);
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << run.err;
  if (json.is_discarded()) return run.err;
  EXPECT_TRUE(json.at("completed").get<bool>());
  return json.at("trajectory_digest");
}

TEST(Determinism, TheWayTwoProcessesMeetDoesNotChangeTheDigest) {
  const TemporaryFolder folder;
  const std::string digest = digestOf(folder / "lcm", {});
  EXPECT_EQ(digestOf(folder / "again", {}), digest);
  EXPECT_EQ(digestOf(folder / "memory", {"--in-process"}), digest);
  EXPECT_EQ(digestOf(folder / "unpinned", {"--no-pin"}), digest);
  EXPECT_NE(digestOf(folder / "seed", {"--in-process", "--seed", "2"}), digest);
}

TEST(Determinism, EveryFileButTimingIsTheSame) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"}) {
    const Finished run = runBallbot({"run", scenarioPath("balance"), "--set", "duration_s=1",
                                     "--quiet", "--out", folder / name});
    ASSERT_NE(run.exit_code, 2) << run.err;
  }
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(folder / "a")) {
    const std::string name = entry.path().filename().string();
    if (name == "timing.json") continue;
    EXPECT_TRUE(readFile(entry.path().string()) == readFile((folder / "b") + "/" + name))
        << name << " differs";
    ++compared;
  }
  EXPECT_EQ(compared, 6) << "scenario, URDF, manifest, log, summary, report";
}

TEST(Determinism, ReplacingThePlantProcessInTheMiddleDoesNotChangeTheDigest) {
  const TemporaryFolder folder;
  const std::string digest = digestOf(folder / "whole", {});
  EXPECT_EQ(digestOf(folder / "replaced", {"--replace-plant-at", "0.7"}), digest);
  EXPECT_EQ(digestOf(folder / "replaced_in_process", {"--in-process", "--replace-plant-at", "0.7"}),
            digest);
}

TEST(Determinism, LossDuplicationAndReorderingDoNotChangeTheDigest) {
  const TemporaryFolder folder;
  const std::string digest = digestOf(folder / "straight", {});
  const std::string port = std::to_string(21000 + ::getpid() % 20000);
  const std::string controller_url = "udpm://239.255.77.1:" + port + "?ttl=0";
  const std::string plant_url = "udpm://239.255.77.2:" + port + "?ttl=0";
  Program plant(
      {"plant", scenarioPath("balance"), "--lcm-url", plant_url, "--set", "duration_s=1.5"});
  Program relay({"relay", controller_url, plant_url, "--loss", "0.2", "--duplication", "0.2",
                 "--reordering", "0.3", "--json"});
  EXPECT_EQ(digestOf(folder / "relayed", {"--lcm-url", controller_url}), digest);
  relay.signal(SIGINT);
  const Finished relayed = relay.finish(10);
  const auto counts = nlohmann::json::parse(relayed.out, nullptr, false);
  ASSERT_FALSE(counts.is_discarded()) << relayed.err;
  const double received = counts["requests"]["received"];
  EXPECT_GT(received, 4000);
  EXPECT_NEAR(counts["requests"]["lost"].get<double>() / received, 0.2, 0.04);
  EXPECT_GT(counts["requests"]["duplicated"].get<double>() / received, 0.1);
  EXPECT_GT(counts["requests"]["held_back"].get<double>() / received, 0.15);
  EXPECT_EQ(plant.finish(30).exit_code, 0);
}

TEST(Determinism, CheckSaysIdenticalOrWhereItDiffers) {
  const TemporaryFolder folder;
  digestOf(folder / "run", {});
  const Finished same = runBallbot({"check", folder / "run", "--quiet"});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_EQ(same.out, "identical\n");
  const Finished other = runBallbot({"check", folder / "run", "--quiet", "--seed", "2"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.out, HasSubstr("SENSOR_FRAME differs"));
}

TEST(Determinism, CompareNamesTheFirstDifference) {
  const TemporaryFolder folder;
  digestOf(folder / "a", {"--in-process"});
  digestOf(folder / "b", {"--in-process", "--set", "controller.lqr.weights.wheel_torque=2.5"});
  const Finished compared = runBallbot({"compare", folder / "a", folder / "b", "--json"});
  EXPECT_EQ(compared.exit_code, 1) << compared.err;
  const auto json = nlohmann::json::parse(compared.out);
  EXPECT_FALSE(json["identical"].get<bool>());
  // Another weight shows first in the plan, not in sensors or truth.
  EXPECT_EQ(json["first_difference"]["channel"], "PLAN_REPORT");
  EXPECT_EQ(runBallbot({"compare", folder / "a", folder / "a"}).exit_code, 0);
}

}  // namespace
}  // namespace ballbot
