#include "core/whole_file.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ballbot {
namespace {

namespace fs = std::filesystem;

class WholeFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  std::string text(const std::string& name) const {
    std::ostringstream out;
    out << std::ifstream(folder_ / name).rdbuf();
    return out.str();
  }
  fs::path folder_ = fs::temp_directory_path() / ("ballbot_whole_file_" + std::to_string(getpid()));
};

TEST_F(WholeFile, ReplacesAFileAndLeavesNothingBeside) {
  EXPECT_EQ(writeWholeFile((folder_ / "a").string(), "first, and longer"), 0);
  EXPECT_EQ(writeWholeFile((folder_ / "a").string(), "second"), 0);
  EXPECT_EQ(text("a"), "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}), 1);
}

TEST_F(WholeFile, SaysWhyNot) {
  EXPECT_EQ(writeWholeFile((folder_ / "none" / "a").string(), "x"), ENOENT);
  EXPECT_EQ(writeWholeFile(folder_.string(), "x"), EISDIR);
}

TEST_F(WholeFile, WritesToADeviceAndNeverReplacesIt) {
  EXPECT_EQ(writeWholeFile("/dev/full", std::string(100'000, 'x')), ENOSPC);
  EXPECT_EQ(writeWholeFile("/dev/null", "x"), 0);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace ballbot
