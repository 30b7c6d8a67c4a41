#include "experiment/recorded_run.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/error.hpp"
#include "experiment/sealed_json.hpp"
#include "experiment/text_file.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class RecordedRun : public ::testing::Test {
 protected:
  RecordedRun()
      : folder_(fs::temp_directory_path() / ("ballbot_recorded_" + std::to_string(::getpid()))),
        run_(RunFolder::create(folder_.string(), "x")) {
    std::ofstream(run_.scenarioFile()) << "name: x\n";
    writeSealedJson(run_.manifestFile(), {{"config_digest", "0"}, {"build", {{"version", "0"}}}});
  }
  ~RecordedRun() override { fs::remove_all(folder_); }

  std::string summaryError() {
    try {
      readSummary(run_);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }

  fs::path folder_;
  RunFolder run_;
};

TEST_F(RecordedRun, AnInterruptedRunHasNoSummary) { EXPECT_FALSE(readSummary(run_)); }

TEST_F(RecordedRun, MetricsThatWereNoNumberComeBackAsNone) {
  writeSealedJson(run_.summaryFile(), {{"simulated_s", 1},
                                       {"log_digest", "a"},
                                       {"fell", false},
                                       {"metrics", {{"tilt_deg", 2.5}, {"drift_m", nullptr}}}});
  const auto summary = readSummary(run_);
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->metrics.at("tilt_deg"), 2.5);
  EXPECT_TRUE(std::isnan(summary->metrics.at("drift_m")));
  EXPECT_EQ(summary->facts.at("fell"), "false");
}

TEST_F(RecordedRun, AWrongTypeIsSaidWithTheFile) {
  writeSealedJson(run_.summaryFile(),
                  {{"simulated_s", "long"}, {"log_digest", ""}, {"metrics", 3}});
  EXPECT_THAT(summaryError(), HasSubstr("summary.json: is not what a run writes"));
}

TEST_F(RecordedRun, AnEditedFileShows) {
  writeSealedJson(run_.summaryFile(),
                  {{"simulated_s", 1.5}, {"log_digest", ""}, {"metrics", {{"tilt_deg", 2.5}}}});
  std::string text = readTextFile(run_.summaryFile());
  text.replace(text.find("2.5"), 3, "2.4");
  std::ofstream(run_.summaryFile()) << text;
  EXPECT_THAT(summaryError(), HasSubstr("is damaged or was edited"));
  std::ofstream(run_.summaryFile()) << "{\"simulated_s\": 1}";
  EXPECT_THAT(summaryError(), HasSubstr("has no 'file_digest'"));
  std::ofstream(run_.summaryFile()) << "[1";
  EXPECT_THAT(summaryError(), HasSubstr("is no JSON object"));
  std::ofstream(run_.summaryFile())
      << "{\"a\":" << std::string(100'000, '[') << std::string(100'000, ']') << "}";
  EXPECT_THAT(summaryError(), HasSubstr("is nested too deep"));
}

}  // namespace
}  // namespace ballbot
