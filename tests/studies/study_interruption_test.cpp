#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <sys/types.h>
#include <unistd.h>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::vector<std::string> smoke(const std::string& out, bool resume) {
  std::vector<std::string> words = {"study",   BALLBOT_SOURCE_DIR "/configs/studies/smoke.yaml",
                                    "--quiet", "--json",
                                    "--jobs",  "2",
                                    "--set",   "duration_s=0.6",
                                    "--out",   out};
  if (resume) words.push_back("--resume");
  return words;
}

std::string digestOf(const Finished& run) {
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  return json.is_discarded() ? "no digest: " + run.err : json["table_digest"].get<std::string>();
}

std::size_t recordsIn(const std::string& folder) {
  const std::string text = readFile(folder + "/results/local.jsonl");
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

bool alive(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/stat");
  std::string number, name, state;
  status >> number >> name >> state;
  return !state.empty() && state != "Z";
}

void waitUntilGone(const std::vector<pid_t>& pids) {
  const auto give_up = Clock::now() + std::chrono::seconds(20);
  for (const pid_t pid : pids) {
    while (alive(pid) && Clock::now() < give_up)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_FALSE(alive(pid)) << "process " << pid << " of a dead study still runs";
  }
}

/// Waits until `count` cases are done and two run. False if the study ended before.
bool waitForRecords(Program& study, const std::string& folder, std::size_t count) {
  const auto give_up = Clock::now() + std::chrono::seconds(200);
  while (Clock::now() < give_up) {
    if (recordsIn(folder) >= count && !study.children().empty()) return true;
    if (fs::exists(folder + "/summary.json")) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

TEST(StudyInterruption, KilledAtRandomMomentsAndResumedItGivesTheSameTable) {
  const TemporaryFolder folder;
  const std::string whole = digestOf(runBallbot(smoke(folder / "whole", false)));
  std::mt19937 random(20260101);
  for (int round = 0; round < 3; ++round) {
    const std::string out = folder / ("killed" + std::to_string(round));
    std::size_t kept = 0;
    for (int kill = 0; kill < 3; ++kill) {
      Program study(smoke(out, fs::exists(out + "/manifest.json")));
      if (!waitForRecords(study, out, kept + random() % 2)) break;
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 200'000));
      const std::vector<pid_t> cases = study.children();
      study.signal(SIGKILL);
      study.finish();
      waitUntilGone(cases);
      const std::size_t now = recordsIn(out);
      EXPECT_GE(now, kept) << "nothing that was done is lost";
      kept = now;
    }
    EXPECT_EQ(digestOf(runBallbot(smoke(out, true))), whole);
    EXPECT_EQ(recordsIn(out), 8u) << "nothing that was done is done again";
  }
}

TEST(StudyInterruption, CtrlCLeavesNoOrphanAndAFolderToGoOnWith) {
  const TemporaryFolder folder;
  const std::string out = folder / "study";
  Program study(smoke(out, false));
  ASSERT_TRUE(waitForRecords(study, out, 1));
  const std::vector<pid_t> cases = study.children();
  EXPECT_FALSE(cases.empty());
  study.signal(SIGINT);
  const Finished end = study.finish(30);
  EXPECT_EQ(end.exit_code, 130);
  EXPECT_THAT(end.err, HasSubstr("go on with\n  ballbot study "));
  EXPECT_THAT(end.err, HasSubstr("--resume --out " + out));
  EXPECT_THAT(end.err, HasSubstr(" --set duration_s="))
      << "without it the folder is another study's";
  waitUntilGone(cases);
  digestOf(runBallbot(smoke(out, true)));
  EXPECT_EQ(recordsIn(out), 8u);
}

TEST(StudyInterruption, ACaseThatDiesIsAResultWithItsReason) {
  const TemporaryFolder folder;
  const std::string out = folder / "study";
  std::vector<std::string> words = smoke(out, false);
  words[7] = "duration_s=4";
  Program study(words);
  ASSERT_TRUE(waitForRecords(study, out, 0));
  ::kill(study.children().front(), SIGSEGV);
  const Finished end = study.finish();
  EXPECT_EQ(end.exit_code, 1) << end.err;
  const auto json = nlohmann::json::parse(end.out, nullptr, false);
  ASSERT_FALSE(json.is_discarded()) << end.err;
  EXPECT_EQ(json["failed"], 1);
  EXPECT_EQ(json["cases"], 8);
  EXPECT_THAT(readFile(out + "/table.csv"), HasSubstr("crashed,signal 11 (Segmentation fault)"));
  // The crash was ours: tried again it runs.
  words.push_back("--resume");
  words.push_back("--retry");
  const auto again = nlohmann::json::parse(runBallbot(words).out, nullptr, false);
  ASSERT_FALSE(again.is_discarded());
  EXPECT_EQ(again["failed"], 0);
}

}  // namespace
}  // namespace ballbot
