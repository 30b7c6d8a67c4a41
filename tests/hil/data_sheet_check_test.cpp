// The bench file against the vendors' data sheets: whatever the drive would refuse later, and what
// it would take but mean otherwise, is said before a bus is touched.
#include "hil/data_sheet_check.hpp"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/yaml_file.hpp"

namespace ballbot {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kBenches = std::string(BALLBOT_SOURCE_DIR) + "/configs/hil/";

std::vector<std::string> disagreements(const std::string& bench,
                                       const std::vector<std::string>& overrides = {}) {
  ConfigNode tree = loadYamlFile(kBenches + bench);
  for (const std::string& text : overrides) applyOverride(tree, text);
  return checkDataSheets(readBenchConfig(tree));
}

TEST(DataSheetCheck, TheShippedBenchesAgreeWithTheirSheets) {
  EXPECT_THAT(disagreements("bench.yaml"), ElementsAre());
  EXPECT_THAT(disagreements("bench.yaml", {"drive_mode=position"}), ElementsAre());
  EXPECT_THAT(disagreements("bench_realtime.yaml"), ElementsAre());
  EXPECT_THAT(disagreements("vendors/quistal/bench.yaml"), ElementsAre());
  EXPECT_THAT(disagreements("vendors/nebelhorn/bench.yaml"), ElementsAre());
}

TEST(DataSheetCheck, ASharedRpdoNeedsDummies) {
  EXPECT_THAT(disagreements("bench_fd.yaml"), ElementsAre());
  std::ifstream in(kBenches + "ballbot_drive.eds");
  std::stringstream text;
  text << in.rdbuf();
  std::string without = text.str();
  without.replace(without.find("Dummy0007=1"), 11, "Dummy0007=0");
  const std::string file = ::testing::TempDir() + "no_dummies.eds";
  std::ofstream(file) << without;
  EXPECT_THAT(
      disagreements("bench_fd.yaml", {"drive_defaults.eds=" + file}),
      ElementsAre(HasSubstr("0007:00 fills up an RPDO that drives share (shared_outputs), " + file +
                            " says Dummy0007=0")));
}

TEST(DataSheetCheck, SaysAtOnceAllThatTheDriveDoesOtherwise) {
  // As if the drives were ordinary ones.
  const auto found =
      disagreements("vendors/quistal/bench.yaml",
                    {"tpdo=null", "drive_defaults.torque_reference_object=\"2032:00\"",
                     "drive_defaults.abort_connection_option=3", "buses.0.bitrate_kbps=500"});
  EXPECT_THAT(found, Contains(AllOf(HasSubstr("vendors/quistal/bench.yaml:10:8: wheel 1, wheel 2, "
                                              "wheel 3, arm 1, arm 2, arm 3: 606C:00"),
                                    HasSubstr("is mapped with 32 bits"),
                                    HasSubstr("has INTEGER16. Map 606C0010"))));
  EXPECT_THAT(found, Contains(HasSubstr("2032:00 torque of 1000 counts in mNm: ")));
  EXPECT_THAT(found, Contains(HasSubstr("has no object 2032")));
  EXPECT_THAT(found, Contains(AllOf(HasSubstr("wheel 1, wheel 2, wheel 3: its bus runs at 500"),
                                    HasSubstr("does not promise (BaudRate_500)"))));
  EXPECT_EQ(found.size(), 4U) << "500 kbit/s for the IMU as well";

  const auto other = disagreements("vendors/nebelhorn/bench.yaml",
                                   {"tpdo=null", "drive_defaults.quick_stop_option=2",
                                    "drive_defaults.fault_reaction_option=2"});
  EXPECT_THAT(other, Contains(HasSubstr("60E4:01 in a TPDO: ")));
  EXPECT_THAT(other, Contains(AllOf(HasSubstr("605A:00 quick stop option is to be 2 (0x2)"),
                                    HasSubstr("allows no less than 5"))));
  EXPECT_THAT(other, Contains(AllOf(HasSubstr("605E:00 fault reaction option is to be 2"),
                                    HasSubstr("allows no more than 0"))));
  EXPECT_EQ(other.size(), 3U);
}

TEST(DataSheetCheck, KnowsWhatConstantsAndConfiguredValuesWillBe) {
  EXPECT_THAT(disagreements("vendors/quistal/bench.yaml", {"drive_defaults.rated_torque_Nm=20"}),
              ElementsAre(AllOf(HasSubstr("2031:00 torque of 1000 counts in mNm is 36000 (0x8ca0)"),
                                HasSubstr("configured 20000"))));
  EXPECT_THAT(disagreements("vendors/quistal/bench.yaml", {"imu.gyro_resolution_rad_per_s=0.001"}),
              ElementsAre(HasSubstr("IMU: 2004:02 gyro resolution")));
  EXPECT_THAT(disagreements("vendors/quistal/bench.yaml", {"imu.eds=null"}), ElementsAre());
}

TEST(DataSheetCheck, RefusesWhatCannotBeMappedOrIsNoSheet) {
  EXPECT_THAT(
      disagreements("vendors/quistal/bench.yaml",
                    {"tpdo=[[60410010, 60770010, 60640020], [606C0010], [60760020]]"}),
      ElementsAre(AllOf(HasSubstr("6076:00 Motor rated torque cannot be mapped into a TPDO"),
                        HasSubstr("PDOMapping=0"))));
  EXPECT_THROW(requireDataSheets(readBenchConfig([] {
                 ConfigNode tree = loadYamlFile(kBenches + "vendors/quistal/bench.yaml");
                 applyOverride(tree, "drive_defaults.encoder_counts_per_turn=4096");
                 applyOverride(tree, "tpdo=null");
                 return tree;
               }())),
               InputError);
  ConfigNode tree = loadYamlFile(kBenches + "bench.yaml");
  applyOverride(tree, "drive_defaults.eds=" + kBenches + "bench.yaml");
  EXPECT_THROW(readBenchConfig(tree), InputError);
}

}  // namespace
}  // namespace ballbot
