#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <unistd.h>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

bool alive(pid_t pid) { return ::kill(pid, 0) == 0; }

/// Waits until `condition` holds, 20 s at most.
template <typename Condition>
bool eventually(Condition condition) {
  for (int i = 0; i < 4000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

std::vector<std::string> longRun(const std::string& out) {
  return {"run", scenarioPath("balance"), "--set", "duration_s=1000", "--quiet", "--out", out};
}

bool logHasGrown(const std::string& folder) {
  return readFile(folder + "/run.lcmlog").size() > 100'000;
}

void expectReadableLog(const std::string& run, const TemporaryFolder& folder) {
  const Finished exported = runBallbot({"export", run, "--csv", folder / "csv", "--json"});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_GT(nlohmann::json::parse(exported.out)["rows"]["truth"].get<int>(), 10);
}

TEST(Faults, CtrlCEndsBothProcessesAndLeavesAReadableLog) {
  const TemporaryFolder folder;
  Program run(longRun(folder / "run"));
  ASSERT_TRUE(eventually([&] { return logHasGrown(folder / "run"); }));
  const auto children = run.children();
  ASSERT_EQ(children.size(), 1u);
  run.signal(SIGINT);
  const Finished end = run.finish(10);
  EXPECT_EQ(end.exit_code, 130) << end.err;
  EXPECT_TRUE(eventually([&] { return !alive(children[0]); }));
  expectReadableLog(folder / "run", folder);
}

TEST(Faults, AKilledPlantIsNamed) {
  const TemporaryFolder folder;
  Program run(longRun(folder / "run"));
  ASSERT_TRUE(eventually([&] { return logHasGrown(folder / "run"); }));
  ::kill(run.children().at(0), SIGKILL);
  const Finished end = run.finish(20);
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_THAT(end.err, HasSubstr("plant"));
  EXPECT_THAT(end.err, HasSubstr("signal 9"));
  expectReadableLog(folder / "run", folder);
}

TEST(Faults, AKilledControllerLeavesNoOrphan) {
  const TemporaryFolder folder;
  Program run(longRun(folder / "run"));
  ASSERT_TRUE(eventually([&] { return logHasGrown(folder / "run"); }));
  const pid_t plant = run.children().at(0);
  run.signal(SIGKILL);
  EXPECT_EQ(run.finish(5).exit_code, 128 + SIGKILL);
  EXPECT_TRUE(eventually([&] { return !alive(plant); }));
  expectReadableLog(folder / "run", folder);
}

TEST(Faults, AFullDiskIsSaidAndWhatWasLoggedStaysReadable) {
  const TemporaryFolder folder;
  Program run(longRun(folder / "run"), 300'000);
  const Finished end = run.finish(60);
  EXPECT_EQ(end.exit_code, 4) << end.err;
  EXPECT_THAT(end.err, HasSubstr("run.lcmlog"));
  expectReadableLog(folder / "run", folder);
}

TEST(Faults, NobodyAtTheOtherEndIsSaidWithWhatToTry) {
  const TemporaryFolder folder;
  const Finished end = runBallbot({"controller", scenarioPath("balance"), "--quiet", "--out",
                                   folder / "run", "--patience-s", "0.5", "--channel", "NOBODY"});
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_THAT(end.err, HasSubstr("no reply from 'plant'"));
  EXPECT_THAT(end.err, HasSubstr("ballbot doctor"));
}

TEST(Faults, ASecondPlantOnTheSameChannelIsRefused) {
  const std::string channel = "TWICE" + std::to_string(::getpid());
  Program first({"plant", scenarioPath("balance"), "--channel", channel});
  ASSERT_TRUE(eventually([&] { return first.errSoFar().find("waiting on") != std::string::npos; }));
  const Finished second = runBallbot({"plant", scenarioPath("balance"), "--channel", channel}, 60);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_THAT(second.err, HasSubstr("already serves"));
  first.signal(SIGTERM);
  EXPECT_EQ(first.finish(10).exit_code, 130);
}

TEST(Faults, APlantOfAnotherScenarioIsRefusedInWords) {
  const TemporaryFolder folder;
  const std::string channel = "OTHER" + std::to_string(::getpid());
  Program plant({"plant", scenarioPath("push"), "--channel", channel});
  const Finished end = runBallbot({"controller", scenarioPath("balance"), "--quiet", "--out",
                                   folder / "run", "--channel", channel});
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_THAT(end.err, HasSubstr("configuration"));
  plant.signal(SIGTERM);
  plant.finish(10);
}

}  // namespace
}  // namespace ballbot
