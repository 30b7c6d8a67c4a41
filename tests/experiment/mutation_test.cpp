// Folders of runs with bytes changed at random from a seed. Whatever the bytes: no crash, no hang,
// no swelling, and "identical" is said of whole folders only. It runs for BALLBOT_MUTATION_SECONDS
// of processor time (default 2), from BALLBOT_MUTATION_SEED (default 1); a failure names its case,
// which BALLBOT_MUTATION_CASE repeats alone.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/random.hpp"
#include "experiment/log_tables.hpp"
#include "experiment/recorded_run.hpp"
#include "experiment/run_comparison.hpp"
#include "experiment/run_experiment.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFiles[] = {"run.lcmlog", "summary.json", "manifest.json", "scenario.yaml",
                                  "robot.urdf"};
// Far above what one case takes, far below a minute or a swollen machine.
constexpr double kLongestCase_s = 10;
#ifdef __SANITIZE_ADDRESS__
constexpr long kMostMemory_kB = 800'000;  // it keeps 256 MB of what was freed
#else
constexpr long kMostMemory_kB = 400'000;
#endif

std::int64_t setting(const char* name, std::int64_t fallback) {
  const char* text = std::getenv(name);
  return text ? parseWhole(text).value_or(fallback) : fallback;
}

double processorSeconds() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

long peakMemory_kB() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

std::string bytesOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void writeBytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// The choices of one case, a function of seed and case alone.
class Choices {
 public:
  Choices(std::uint64_t seed, std::int64_t number)
      : random_(seed, "mutation"), number_(static_cast<std::uint64_t>(number)) {}
  /// 0 .. count-1
  std::size_t below(std::size_t count) {
    const double share = random_.uniforms(number_, next_++)[0];
    return std::min(count - 1, static_cast<std::size_t>(share * static_cast<double>(count)));
  }

 private:
  RandomStream random_;
  std::uint64_t number_, next_ = 0;
};

std::string mutated(const std::string& original, Choices& choose) {
  constexpr unsigned char kTelling[] = {0x00, 0xff, 0x7f, 0x80, 0xED, '0', '9', '-', '"', '\n'};
  std::string bytes = original;
  for (std::size_t edits = 1 + choose.below(3); edits > 0 && !bytes.empty(); --edits) {
    const std::size_t at = choose.below(bytes.size());
    const std::size_t length = std::min(bytes.size() - at, 1 + choose.below(40));
    switch (choose.below(7)) {
      case 0:
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << choose.below(8)));
        break;
      case 2:
        bytes[at] = static_cast<char>(kTelling[choose.below(std::size(kTelling))]);
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 4:
        bytes.insert(at, bytes.substr(choose.below(bytes.size()), length));
        break;
      case 5:
        bytes.resize(at);
        break;
      default:
        bytes.replace(at, length, std::string(length, static_cast<char>(choose.below(256))));
    }
  }
  return bytes;
}

/// A short run, made once.
class Mutation : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    base_ = fs::temp_directory_path() / ("ballbot_mutation_" + std::to_string(::getpid()));
    const Scenario scenario = loadScenario(
        std::string(BALLBOT_SOURCE_DIR) + "/configs/scenarios/balance.yaml",
        {"duration_s=0.2", "controller.kind=lqr", "requirements={}", "initial.release_s=0.1"});
    RunOptions options;
    options.in_process = true;
    options.write_report = false;
    runExperiment(scenario, (base_ / "whole").string(), options);
    fs::copy(base_ / "whole", base_ / "changed", fs::copy_options::recursive);
  }
  static void TearDownTestSuite() { fs::remove_all(base_); }

  static fs::path base_;
};
fs::path Mutation::base_;

/// What reading a folder and comparing it with the whole one says; empty if "identical".
std::string complaintAbout(const RunFolder& changed, const RunFolder& whole) {
  try {
    logTables(readRecordedLog(changed));
  } catch (const InputError&) {
    // In words, as it should be; the comparison says the same.
  }
  try {
    const RunComparison c = compareRuns(whole, changed);
    if (!c.identical()) return c.text();
    return c.notes.empty() ? "" : c.notes.front();
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST_F(Mutation, AnUnchangedFolderIsIdentical) {
  EXPECT_EQ(complaintAbout(RunFolder::open((base_ / "changed").string()),
                           RunFolder::open((base_ / "whole").string())),
            "");
}

TEST_F(Mutation, WhateverTheBytesDamageIsSaidInWords) {
  const auto seed = static_cast<std::uint64_t>(setting("BALLBOT_MUTATION_SEED", 1));
  const std::int64_t only = setting("BALLBOT_MUTATION_CASE", -1);
  const auto budget_s = static_cast<double>(setting("BALLBOT_MUTATION_SECONDS", 2));
  const RunFolder whole = RunFolder::open((base_ / "whole").string());
  const RunFolder changed = RunFolder::open((base_ / "changed").string());
  const std::string effective = loadScenario(whole.scenarioFile()).configDigest();
  const long memory_before = peakMemory_kB();
  const double begin = processorSeconds();
  std::int64_t number = only >= 0 ? only : 0;
  do {
    SCOPED_TRACE("BALLBOT_MUTATION_SEED=" + std::to_string(seed) +
                 " BALLBOT_MUTATION_CASE=" + std::to_string(number));
    Choices choose(seed, number);
    const std::string name = kFiles[choose.below(std::size(kFiles))];
    const std::string original = bytesOf(fs::path(whole.path()) / name);
    const std::string bytes = mutated(original, choose);
    writeBytes(fs::path(changed.path()) / name, bytes);

    const double case_begin = processorSeconds();
    std::string complaint;
    ASSERT_NO_THROW(complaint = complaintAbout(changed, whole)) << name;
    EXPECT_LT(processorSeconds() - case_begin, kLongestCase_s) << name;
    // A comment, a space: a scenario may be written otherwise and say the same.
    const bool same =
        bytes == original || (name == "scenario.yaml" && complaint.empty() &&
                              loadScenario(changed.scenarioFile()).configDigest() == effective);
    EXPECT_EQ(complaint.empty(), same) << name << ": '" << complaint << "'";
    writeBytes(fs::path(changed.path()) / name, original);
    ++number;
  } while (only < 0 && !HasFailure() && processorSeconds() - begin < budget_s);
  EXPECT_LT(peakMemory_kB() - memory_before, kMostMemory_kB);
  RecordProperty("cases", static_cast<int>(number));
}

}  // namespace
}  // namespace ballbot
