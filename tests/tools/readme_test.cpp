#include <algorithm>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

/// The words of each `ballbot run` of a scenario in the README that says more than the scenario;
/// those that do not are the scenarios' own test.
std::vector<std::vector<std::string>> readmeRuns() {
  std::vector<std::vector<std::string>> runs;
  std::ifstream readme(std::string(BALLBOT_SOURCE_DIR) + "/README.md");
  for (std::string line; std::getline(readme, line);) {
    if (line.rfind("ballbot run configs/", 0) != 0) continue;
    std::istringstream text(line.substr(0, line.find('#')));
    std::vector<std::string> words;
    for (std::string word; text >> word;) words.push_back(word);
    words.erase(words.begin());
    words[1] = std::string(BALLBOT_SOURCE_DIR) + "/" + words[1];
    if (words.size() > 2) runs.push_back(words);
  }
  return runs;
}

TEST(Readme, WhatItTellsToRunPasses) {
  const auto runs = readmeRuns();
  ASSERT_FALSE(runs.empty());
  for (std::vector<std::string> words : runs) {
    const TemporaryFolder folder;
    for (const std::string& word :
         {std::string("--quiet"), std::string("--no-report"), std::string("--in-process"),
          std::string("--out"), folder / "run"}) {
      words.push_back(word);
    }
    const Finished run = runBallbot(words);
    EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  }
}

}  // namespace
}  // namespace ballbot
