#include "messages/message_text.hpp"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace ballbot {
namespace {

// The definitions in messages/ are what the table of signals says, so no list is kept twice.
TEST(MessageText, TheFilesAreWrittenFromTheTable) {
  const std::vector<WrittenFile> files = messageFiles();
  ASSERT_EQ(files.size(), 6U);
  for (const WrittenFile& file : files) {
    std::stringstream found;
    found << std::ifstream(std::string(BALLBOT_SOURCE_DIR) + "/messages/" + file.name).rdbuf();
    EXPECT_EQ(found.str(), file.text)
        << file.name << " is not what model/signal_table.cpp says: run messages/write_messages of "
        << "the build folder with the folder messages/";
  }
}

TEST(MessageText, AFieldOfSeveralSignalsHasAllTheirWords) {
  for (const WrittenFile& file : messageFiles()) {
    if (file.name != "sensor_frame.lcm") continue;
    EXPECT_NE(file.text.find("double  pose_W[3];"), std::string::npos) << file.text;
    EXPECT_NE(file.text.find("in the world [m];"), std::string::npos) << file.text;
    EXPECT_NE(file.text.find("int64_t pose_time_ns;"), std::string::npos) << file.text;
    return;
  }
  FAIL() << "no sensor_frame.lcm";
}

}  // namespace
}  // namespace ballbot
