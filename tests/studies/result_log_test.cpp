#include "studies/result_log.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <unistd.h>

#include "core/error.hpp"
#include "experiment/text_file.hpp"

namespace ballbot {
namespace {

using ::testing::ElementsAre;
namespace fs = std::filesystem;

class ResultLogFile : public ::testing::Test {
 protected:
  ResultLogFile()
      : path_((fs::temp_directory_path() / ("result_log_" + std::to_string(::getpid()))).string()) {
  }
  ~ResultLogFile() override { fs::remove(path_); }
  std::string path_;
};

TEST_F(ResultLogFile, KeepsWhatWasAppendedInItsOrder) {
  {
    ResultLog log(path_);
    log.append("one");
    log.append("{\"two\": 2}");
  }
  ResultLog(path_).append("three");
  const ResultLogContent content = readResultLog(path_);
  EXPECT_THAT(content.records, ElementsAre("one", "{\"two\": 2}", "three"));
  EXPECT_EQ(content.damaged, 0);
}

TEST_F(ResultLogFile, CutOffAnywhereLosesOnlyTheRecordThatWasCut) {
  ResultLog(path_).append("first");
  const std::size_t first = readTextFile(path_).size();
  ResultLog(path_).append("second");
  const std::string whole = readTextFile(path_);
  for (std::size_t cut = first; cut + 1 < whole.size(); ++cut) {
    fs::resize_file(path_, cut);
    EXPECT_THAT(readResultLog(path_).records, ElementsAre("first")) << cut;
    EXPECT_EQ(readResultLog(path_).damaged, cut > first ? 1 : 0) << cut;
    ResultLog(path_).append("next");
    EXPECT_THAT(readResultLog(path_).records, ElementsAre("first", "next")) << cut;
    writeTextFile(path_, whole);
  }
}

TEST_F(ResultLogFile, ARecordThatLacksOnlyItsLineEndIsWhole) {
  ResultLog(path_).append("first");
  fs::resize_file(path_, readTextFile(path_).size() - 1);
  EXPECT_THAT(readResultLog(path_).records, ElementsAre("first"));
  EXPECT_EQ(readResultLog(path_).damaged, 0);
  ResultLog(path_).append("next");
  EXPECT_THAT(readResultLog(path_).records, ElementsAre("first", "next"));
}

TEST_F(ResultLogFile, ADamagedRecordIsNotBelieved) {
  ResultLog(path_).append("value 17");
  std::string text = readTextFile(path_);
  text[text.find("17")] = '9';
  writeTextFile(path_, text);
  EXPECT_TRUE(readResultLog(path_).records.empty());
  EXPECT_EQ(readResultLog(path_).damaged, 1);
}

TEST_F(ResultLogFile, SaysWhenTheFileCannotBeOpened) {
  try {
    ResultLog log("/no/such/folder/log");
    FAIL() << "opened a file in a folder that is not there";
  } catch (const OutputError& e) {
    EXPECT_STREQ(e.what(), "/no/such/folder/log: cannot be opened: No such file or directory");
  }
}

}  // namespace
}  // namespace ballbot
