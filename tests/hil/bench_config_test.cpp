// What a bench file may say of CAN FD, and what it asks of its buses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "hil/bus_budget.hpp"
#include "hil/shared_outputs.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

BenchConfig benchOf(const std::string& file, const std::vector<std::string>& overrides) {
  ConfigNode tree = loadYamlFile(std::string(BALLBOT_SOURCE_DIR) + "/configs/hil/" + file);
  for (const std::string& text : overrides) applyOverride(tree, text);
  return readBenchConfig(tree);
}

std::string refusal(const std::string& file, const std::vector<std::string>& overrides) {
  try {
    requireRoom(benchOf(file, overrides));
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(BenchConfig, CanFdHasLongPdosAndClassicCanHasNot) {
  const BenchConfig fd = benchOf("bench_fd.yaml", {});
  EXPECT_TRUE(fd.flexible());
  EXPECT_EQ(fd.inputs.size(), 1U);
  EXPECT_EQ(fd.inputs[0].bytes(), 18);
  EXPECT_EQ(fd.inputs[0].frameBytes(), 20);
  const std::string all = "tpdo=[[60410010, 60770010, 60640020, 606C0020, 60E40120, 60740010]]";
  EXPECT_THAT(refusal("bench.yaml", {all}),
              HasSubstr("tpdo: a PDO of 18 bytes; at most 8 fit in a classic CAN frame"));
  EXPECT_THAT(refusal("bench_fd.yaml", {"buses.1.fd=null"}),
              HasSubstr("must be there for both buses or for none"));
  EXPECT_THAT(refusal("bench_fd.yaml", {"buses.0.fd.data_bitrate_kbps=500"}),
              HasSubstr("data_bitrate_kbps is 500, must be between 1000 and 8000"));
}

TEST(BenchConfig, DrivesOfABusShareAnRpdoWhereItHasRoom) {
  const BenchConfig fd = benchOf("bench_fd.yaml", {});
  const PdoMapping second = sharedOutputs(fd, fd.drives[1]);
  std::vector<std::uint32_t> codes;
  for (const PdoEntry& entry : second.entries()) codes.push_back(entry.code());
  EXPECT_EQ(codes, (std::vector<std::uint32_t>{0x00070020, 0x60400010, 0x60710010, 0x00070020}));
  EXPECT_EQ(sharedOffset(fd, fd.drives[1]), 4);
  EXPECT_EQ(sharedFrame(fd, 0).id, 0x201U);
  EXPECT_EQ(sharedFrame(fd, 1).id, 0x204U);
  EXPECT_EQ(sharedFrame(fd, 1).size, 12);
  EXPECT_THAT(refusal("bench.yaml", {"shared_outputs=true"}),
              HasSubstr("shared_outputs would need 12 bytes in a frame on bus 0, at most 8 fit"));
  EXPECT_THAT(refusal("bench.yaml", {"shared_outputs=true", "drive_mode=position"}),
              HasSubstr("shared_outputs needs all outputs of a drive in one RPDO, there are 2"));
}

TEST(BenchConfig, NamesTheKeyAndWhatItMustBe) {
  EXPECT_THAT(refusal("bench.yaml", {"drive_defaults.sign=0.5"}),
              HasSubstr(": sign must be 1 or -1"));
  EXPECT_THAT(refusal("bench.yaml", {"drives.1.node=1"}), HasSubstr(": node 1 is taken on bus 0"));
  EXPECT_THAT(refusal("bench.yaml", {"drives=[{node: 1}]"}),
              HasSubstr(": drives has 1 entries, must be 6: wheels 1 to 3"));
}

TEST(BenchConfig, AVelocityUnitForAllDrivesIsThatOfAllDrives) {
  const BenchConfig c = benchOf("bench.yaml", {"drive_defaults.velocity_unit_rad_per_s=0.5",
                                               "drives.2.velocity_unit_rad_per_s=0.25"});
  EXPECT_EQ(c.drives[0].scaling.velocity_unit, 0.5);
  EXPECT_EQ(c.drives[2].scaling.velocity_unit, 0.25);
}

// By hand, for three drives and the IMU: 47 bits of SYNC, 79 of an RPDO with 4 bytes, 111 of a PDO
// with 8 and 63 of one with 2, 95 of the IMU's second.
TEST(BusBudget, IsWhatTheFramesOfACycleNeed) {
  const BenchConfig c = benchOf("bench.yaml", {"safety.read_back_cycles=0"});
  const double cycle = 47 + 3 * (79 + 111 + 111 + 63) + 111 + 95;
  const double heartbeats = 55 / 2.0 + 4 * 55 / 4.0;  // every 5 ms and 10 ms
  EXPECT_NEAR(busBudget(c)[0].nominal, (cycle + heartbeats) / 2500, 1e-9);
  EXPECT_EQ(busBudget(c)[0].frames_per_cycle, 15);
}

TEST(BusBudget, ARealBenchMustHaveRoomForItsFrames) {
  EXPECT_EQ(refusal("bench_fd.yaml", {"stepped=false"}), "no error");
  EXPECT_THAT(
      refusal("bench_realtime.yaml", {"cycle_us=400", "realtime={collect_us: 200, act_us: 300}"}),
      HasSubstr("bus 0 (slcan:/tmp/ballbot-can0) would need 3"));
  EXPECT_EQ(refusal("bench_realtime.yaml", {}), "no error");
}

}  // namespace
}  // namespace ballbot
