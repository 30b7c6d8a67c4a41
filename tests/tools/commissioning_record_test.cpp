#include "tools/commissioning_record.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

const char* const kBench =
    "{scenario: a.yaml, cycle_us: 2500, buses: [{address: can0}], drives: [{node: 1}, {node: 2, "
    "sign: -1}], emulator: {rig: {}}}";

std::vector<NodeReport> twoNodes() {
  NodeReport a, b;
  a.name = "wheel 1";
  a.node = 1;
  a.serial = 0x11;
  b.name = "wheel 2";
  b.node = 2;
  b.serial = 0x22;
  return {a, b};
}

CommissioningRecord recorded(const char* bench = kBench) {
  return recordOf(parseYaml(bench, "bench.yaml"), twoNodes(), "M. Curie");
}

class CommissioningRecordFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_ =
      fs::temp_directory_path() / ("ballbot-commissioned-" + std::to_string(::getpid()));
  std::string path_ = (folder_ / "bench.commissioned.json").string();
};

TEST_F(CommissioningRecordFile, IsReadAsItWasWritten) {
  writeCommissioningRecord(path_, recorded(), {{{"stand still", true, "9.81"}}, false, true});
  const CommissioningRecord back = readCommissioningRecord(path_);
  EXPECT_EQ(back.by, "M. Curie");
  EXPECT_THAT(changesSince(back, recorded()), IsEmpty());
}

TEST_F(CommissioningRecordFile, IsNotBelievedOnceItWasEdited) {
  writeCommissioningRecord(path_, recorded(), {});
  std::stringstream text;
  text << std::ifstream(path_).rdbuf();
  std::string changed = text.str();
  changed.replace(changed.find("Curie"), 5, "Other");
  std::ofstream(path_) << changed;
  EXPECT_THROW(readCommissioningRecord(path_), InputError);
}

TEST_F(CommissioningRecordFile, SaysWhichRecordIsMissing) {
  try {
    readCommissioningRecord(path_);
    FAIL() << "there is none";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("bench.commissioned.json"));
  }
}

TEST(CommissioningRecord, NamesWhatHasChanged) {
  EXPECT_THAT(
      changesSince(recorded(), recorded("{cycle_us: 2500, buses: [{address: can0}], drives: "
                                        "[{node: 1}, {node: 2, sign: 1}]}")),
      ElementsAre("drives.1.sign was -1, is 1"))
      << "what says nothing about the bench does not count";
  CommissioningRecord other = recorded();
  std::vector<NodeReport> nodes = twoNodes();
  nodes[1].serial = 0x33;
  other.nodes = recordOf(parseYaml(kBench, ""), nodes, "").nodes;
  const auto changes = changesSince(recorded(), other);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_THAT(changes[0], HasSubstr("serial 00000033"));
  EXPECT_THAT(
      changesSince(recorded(), recorded("{cycle_us: 2500, buses: [{address: can0}], drives: "
                                        "[{node: 1}, {node: 2}]}")),
      ElementsAre("drives.1.sign was -1, is not there any more"));
}

TEST(CommissioningRecord, LiesBesideTheBenchFile) {
  EXPECT_EQ(commissioningPath("configs/hil/bench.yaml"), "configs/hil/bench.commissioned.json");
}

}  // namespace
}  // namespace ballbot
