// Streams that take nothing, folders that are damaged, edited, interrupted or read-only, and
// numbers that are none: said in words, with the exit code for it, before time is spent.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A run of the LQR that takes a moment.
std::vector<std::string> quickRun(const std::string& out) {
  return {"run",          scenarioPath("balance"),
          "--in-process", "--no-report",
          "--out",        out,
          "--set",        "duration_s=0.6",
          "--set",        "controller.kind=lqr",
          "--set",        "requirements={}"};
}

/// Runs a shell's line in which $B is the program. @return its exit code
int shell(const std::string& line) {
  const int status =
      std::system(("B='" + std::string(BALLBOT_BIN_DIR) + "/ballbot'; " + line).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string runLine(const std::string& out) {
  std::string line = "$B";
  for (const std::string& word : quickRun(out)) line += " '" + word + "'";
  return line;
}

class Damage : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    original_ = new TemporaryFolder;
    ASSERT_EQ(runBallbot(quickRun(*original_ / "run")).exit_code, 0);
  }
  static void TearDownTestSuite() { delete original_; }
  Damage() { fs::copy(*original_ / "run", run, fs::copy_options::recursive); }

  void flip(const std::string& file, std::size_t at) {
    std::string bytes = readFile(run + "/" + file);
    bytes.at(at) = static_cast<char>(bytes[at] ^ 1);
    std::ofstream(run + "/" + file, std::ios::binary) << bytes;
  }
  /// Each verb that reads a run to judge it, and what it must say.
  void expectRefused(const std::string& words) {
    const std::string whole = *original_ / "run";
    for (const std::vector<std::string>& verb : {std::vector<std::string>{"check", run},
                                                 {"compare", whole, run},
                                                 {"compare", run, whole}}) {
      const Finished end = runBallbot(verb, 20);
      EXPECT_EQ(end.exit_code, 2) << verb[0] << end.out;
      EXPECT_THAT(end.err, HasSubstr(words)) << verb[0];
      EXPECT_EQ(end.out, "") << verb[0];
    }
  }

  static TemporaryFolder* original_;
  TemporaryFolder folder;
  std::string run = folder / "run";
};
TemporaryFolder* Damage::original_ = nullptr;

TEST_F(Damage, OneFlippedBitOfTheLogIsFoundAndTheRestExported) {
  const std::size_t middle = readFile(run + "/run.lcmlog").size() / 2;
  flip("run.lcmlog", middle);
  expectRefused("run.lcmlog: damaged at byte ");
  const Finished exported = runBallbot({"export", run, "--csv", folder / "csv", "--json"});
  EXPECT_EQ(exported.exit_code, 2);
  EXPECT_THAT(exported.err, HasSubstr("What is readable was exported"));
  const auto json = nlohmann::json::parse(exported.out);
  EXPECT_THAT(json["damaged"].get<std::string>(), HasSubstr("damaged at byte "));
  EXPECT_GT(json["rows"]["truth"].get<int>(), 200);
}

TEST_F(Damage, AnEditedScenarioIsNotWhatWasRun) {
  std::string text = readFile(run + "/scenario.yaml");
  text.replace(text.find("pitch_deg: 3"), 12, "pitch_deg: 2");
  std::ofstream(run + "/scenario.yaml") << text;
  expectRefused("scenario.yaml, robot.urdf or an FMU in it is not what was run");
  const Finished tail = runBallbot({"run", "--from", run + "@0.3s", "--out", folder / "tail"}, 20);
  EXPECT_EQ(tail.exit_code, 2);
  EXPECT_THAT(tail.err, HasSubstr("is not what was run"));
  EXPECT_FALSE(fs::exists(folder / "tail"));
}

TEST_F(Damage, AnEditedSummaryOrManifestShows) {
  flip("summary.json", readFile(run + "/summary.json").find("largest_tilt_deg") + 19);
  expectRefused("is damaged or was edited");
  fs::copy_file((*original_ / "run") + "/summary.json", run + "/summary.json",
                fs::copy_options::overwrite_existing);
  flip("manifest.json", readFile(run + "/manifest.json").find("0.1.0"));
  expectRefused("manifest.json: is damaged or was edited");
}

TEST_F(Damage, AnInterruptedRunIsRefusedAtOnceByCheckAndComparedAsFarAsItReaches) {
  fs::remove(run + "/summary.json");
  const Finished check = runBallbot({"check", run}, 5);
  EXPECT_EQ(check.exit_code, 2);
  EXPECT_THAT(check.err, HasSubstr("was interrupted (there is no summary.json)"));
  fs::resize_file(run + "/run.lcmlog", fs::file_size(run + "/run.lcmlog") / 2);
  const Finished compared = runBallbot({"compare", *original_ / "run", run});
  EXPECT_EQ(compared.exit_code, 1) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr("run.lcmlog ended before"));
  EXPECT_THAT(compared.out, HasSubstr("so it has no metrics"));
}

TEST_F(Damage, ALogWithNothingOfARunIsNamed) {
  fs::remove(run + "/summary.json");
  const auto exported = [&] { return runBallbot({"export", run, "--csv", folder / "csv"}); };
  fs::resize_file(run + "/run.lcmlog", 0);
  EXPECT_EQ(exported().exit_code, 2);
  EXPECT_THAT(exported().err, HasSubstr("run.lcmlog: is empty"));
  // An event as any LCM program writes it: sync word, number, time, sizes, channel, data.
  std::ofstream(run + "/run.lcmlog", std::ios::binary)
      << std::string("\xED\xA1\xDA\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\6\0\0\0\4", 28)
      << "CAMERAdata";
  EXPECT_EQ(exported().exit_code, 2);
  EXPECT_THAT(exported().err, HasSubstr("events of other channels such as 'CAMERA'"));
  EXPECT_FALSE(fs::exists(folder / "csv"));
}

TEST_F(Damage, ARunIsCheckedWithoutWritingBesideIt) {
  const std::set<fs::path> before(fs::directory_iterator(fs::path(run).parent_path()), {});
  Program check({"check", run, "--in-process"});
  while (check.errSoFar().empty()) ::usleep(1000);  // it simulates
  const std::set<fs::path> during(fs::directory_iterator(fs::path(run).parent_path()), {});
  EXPECT_EQ(before, during) << "the folder may be read-only";
  EXPECT_EQ(check.finish().exit_code, 0);
  EXPECT_EQ(shell("TMPDIR=/nowhere $B check '" + run + "' 2>'" + (folder / "err") + "'"), 4);
  EXPECT_THAT(readFile(folder / "err"), HasSubstr("Name another one in TMPDIR"));
}

TEST_F(Damage, AnEstimateWithOtherSettingsReplacesNone) {
  ASSERT_EQ(runBallbot({"estimate", run, "--no-report"}).exit_code, 0);
  const std::string first = readFile(run + "/estimate/estimate.json");
  for (int i = 0; i < 2; ++i) {
    const Finished other =
        runBallbot({"estimate", run, "--no-report", "--set", "estimator.noise.accel_inflation=1"});
    ASSERT_EQ(other.exit_code, 0) << other.err;
  }
  EXPECT_EQ(readFile(run + "/estimate/estimate.json"), first);
  EXPECT_TRUE(fs::exists(run + "/estimate-001/estimate.json"));
  EXPECT_TRUE(fs::exists(run + "/estimate-002/estimate.json"));
}

TEST(Streams, WhatStdoutDidNotTakeIsSaid) {
  const TemporaryFolder folder;
  const std::string err = folder / "err";
  EXPECT_EQ(shell(runLine(folder / "a") + " --json >/dev/full 2>'" + err + "'"), 4);
  EXPECT_THAT(readFile(err), HasSubstr("the output on stdout could not be written: No space left"));
  EXPECT_TRUE(fs::exists((folder / "a") + "/summary.json")) << "the run itself is complete";
  EXPECT_EQ(shell("$B --help >/dev/full 2>/dev/null"), 4);
  EXPECT_EQ(shell("$B --version >&- 2>/dev/null"), 4);
}

TEST(Streams, LostProgressEndsNothing) {
  const TemporaryFolder folder;
  int number = 0;
  for (const char* lost : {"2>/dev/full", "2>&-", "2>&- <&- >/dev/null"}) {
    const std::string run = folder / std::to_string(++number);
    EXPECT_EQ(shell(runLine(run) + " >/dev/null " + lost), 0) << lost;
    EXPECT_TRUE(fs::exists(run + "/summary.json")) << lost;
    EXPECT_EQ(runBallbot({"compare", run, folder / "1"}).exit_code, 0) << lost;
  }
}

TEST(Streams, AFileSizeLimitIsSaidAndLeavesNoHalfFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(shell("ulimit -f 8; " + runLine(folder / "run") + " 2>'" + (folder / "err") + "'"), 4);
  EXPECT_THAT(readFile(folder / "err"), HasSubstr("File too large"));
  ASSERT_EQ(runBallbot(quickRun(folder / "whole")).exit_code, 0);
  EXPECT_EQ(shell("ulimit -f 8; $B export '" + (folder / "whole") + "' --hdf5 '" +
                  (folder / "x.h5") + "' 2>'" + (folder / "err") + "'"),
            4);
  EXPECT_THAT(readFile(folder / "err"), HasSubstr("x.h5: cannot be written: File too large"));
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(folder / "x.h5").parent_path())) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    EXPECT_NE(entry.path().filename(), "x.h5");
  }
}

TEST(Streams, AnHdf5FileOnAFullDiskIsAnError) {
  const TemporaryFolder folder;
  ASSERT_EQ(runBallbot(quickRun(folder / "run")).exit_code, 0);
  const Finished end =
      Program({"export", folder / "run", "--hdf5", folder / "x.h5"}, 10'000).finish();
  EXPECT_EQ(end.exit_code, 4) << end.err;
  EXPECT_FALSE(fs::exists(folder / "x.h5"));
}

/// Options whose value is no number as configuration files have them.
TEST(Numbers, OnTheCommandLineAreReadAsInFiles) {
  const TemporaryFolder folder;
  const auto words = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = quickRun(folder / "none");
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished end = runBallbot(arguments, 20);
    EXPECT_EQ(end.exit_code, 2) << more.back();
    EXPECT_FALSE(fs::exists(folder / "none"));
    return end.err;
  };
  EXPECT_THAT(words({"--seed", "0x10"}), HasSubstr("'0x10' is not a number; write it in decimal"));
  EXPECT_THAT(words({"--seed", ""}), HasSubstr("'' is not a number"));
  EXPECT_THAT(words({"--seed", "1.5"}), HasSubstr("'1.5' is not a whole number"));
  EXPECT_THAT(words({"--seed=-1"}), HasSubstr("-1 is negative"));
  EXPECT_THAT(words({"--patience-s", "nan"}), HasSubstr("'nan' is not a number"));
  EXPECT_THAT(words({"--set", "seed=1.5"}), HasSubstr("seed is 1.5, must be a whole number"));
  EXPECT_THAT(words({"--set", "initial.pitch_deg=+-0.6"}),
              HasSubstr("pitch_deg is +-0.6, must be a number"));
  EXPECT_THAT(words({"--set", "name=../../evil"}),
              HasSubstr("name is '../../evil', must be the name of a file"));
  EXPECT_THAT(words({"--set", "rates.plan_latency_us=12345"}),
              HasSubstr("rates.plan_latency_us 12.345 ms is not a whole multiple"));
  std::vector<std::string> octal = quickRun(folder / "twelve");
  octal.insert(octal.end(), {"--seed", "012"});
  ASSERT_EQ(runBallbot(octal).exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(readFile((folder / "twelve") + "/manifest.json"))["seed"], 12);
}

}  // namespace
}  // namespace ballbot
