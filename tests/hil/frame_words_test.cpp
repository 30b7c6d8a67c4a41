#include "hil/record/frame_words.hpp"

#include <gtest/gtest.h>

#include "hil/record/can_log_text.hpp"
#include "hil/rehearsal/rehearsal.hpp"

namespace ballbot {
namespace {

RecordedFrame framed(std::uint32_t id, std::vector<std::uint8_t> bytes, bool sent = false) {
  RecordedFrame f;
  f.frame.id = id;
  f.frame.size = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), f.frame.data.begin());
  f.sent = sent;
  return f;
}

struct Said {
  std::uint32_t id;
  std::vector<std::uint8_t> bytes;
  bool sent;
  std::string who, service, meaning;
};

// Rated torque 20 Nm, 14400 counts a turn; CiA 301 and CiA 402 say the rest.
const Said kFrames[] = {
    {0x000, {0x81, 0}, true, "all nodes", "NMT", "reset node"},
    {0x000, {0x02, 3}, true, "wheel 3", "NMT", "stop"},
    {0x000, {0x02, 3}, false, "wheel 3", "NMT", "FROM SOMEBODY ELSE: stop"},
    {0x080, {}, true, "all nodes", "SYNC", ""},
    {0x082,
     {0x10, 0x43, 8, 0, 0, 0, 0, 0},
     false,
     "wheel 2",
     "EMCY",
     "4310 (drive too hot), error register 08"},
    {0x181,
     {0x37, 0x16, 0xF6, 0xFF, 0x10, 0x0E, 0, 0},
     false,
     "wheel 1",
     "TPDO1",
     "6041:00 statusword 1637 (operation enabled), 6077:00 torque -0.2 Nm, 6064:00 joint angle "
     "1.5708 rad"},
    {0x181, {0x37, 0x16}, false, "wheel 1", "TPDO1", "2 bytes, the mapping has 8: bytes 37 16"},
    {0x201,
     {0x0F, 0, 0x32, 0},
     true,
     "wheel 1",
     "RPDO1",
     "6040:00 controlword 000F (enable operation), 6071:00 torque command 1 Nm"},
    {0x201,
     {0x0F, 0, 0x32, 0},
     false,
     "wheel 1",
     "RPDO1",
     "FROM SOMEBODY ELSE: 6040:00 controlword 000F (enable operation), 6071:00 torque command 1 "
     "Nm"},
    {0x602,
     {0x40, 0x72, 0x60, 0, 0, 0, 0, 0},
     true,
     "wheel 2",
     "SDO request",
     "read 6072:00 max torque in per mille"},
    {0x582,
     {0x4B, 0x72, 0x60, 0, 0xDC, 0x05, 0, 0},
     false,
     "wheel 2",
     "SDO answer",
     "6072:00 max torque in per mille 1500"},
    {0x602,
     {0x2F, 0x60, 0x60, 0, 0x0A, 0, 0, 0},
     true,
     "wheel 2",
     "SDO request",
     "write 6060:00 mode of operation 10"},
    {0x582,
     {0x60, 0x60, 0x60, 0, 0, 0, 0, 0},
     false,
     "wheel 2",
     "SDO answer",
     "written 6060:00 mode of operation"},
    {0x582,
     {0x41, 0x08, 0x10, 0, 22, 0, 0, 0},
     false,
     "wheel 2",
     "SDO answer",
     "1008:00 device name, 22 bytes to come"},
    {0x582,
     {0x0B, 'a', 'b', 0, 0, 0, 0, 0},
     false,
     "wheel 2",
     "SDO answer",
     "next bytes 61 62, the last"},
    {0x70C, {0x7F}, false, "node 12", "heartbeat", "pre-operational"},
    {0x77F, {0x05}, true, "master", "heartbeat", "operational"},
    {0x77F, {0x05}, false, "master", "heartbeat", "FROM SOMEBODY ELSE: operational"},
    {0x287,
     {1, 0, 0, 0, 0xFF, 0xFF},
     false,
     "IMU",
     "TPDO2",
     "angular rate x 0.001065, y 0, z -0.001065 rad/s"},
    {0x7E5, {1}, false, "node 101", "unknown", "bytes 01"},
};

TEST(FrameWords, SayNodeServiceObjectsAndValues) {
  BenchConfig config = Rehearsal::defaultConfig();
  for (DriveConfig& d : config.drives) {
    d.scaling.torque_reference = 20;
    d.scaling.encoder_counts = 14400;
  }
  for (const Said& s : kFrames) {
    const FrameWords w = wordsOf(framed(s.id, s.bytes, s.sent), config);
    EXPECT_EQ(w.who, s.who) << std::hex << s.id;
    EXPECT_EQ(w.service, s.service) << std::hex << s.id;
    EXPECT_EQ(w.meaning, s.meaning) << std::hex << s.id;
  }
  const FrameWords refused =
      wordsOf(framed(0x582, {0x80, 0x72, 0x60, 0, 0x30, 0, 0x09, 0x06}), config);
  EXPECT_EQ(refused.meaning.find("refused 6072:00 max torque in per mille: 06090030 ("), 0U)
      << refused.meaning;
  RecordedFrame lost = framed(0x080, {}, true);
  lost.refused = true;
  EXPECT_EQ(wordsOf(lost, config).meaning, "NOT SENT");
}

TEST(CanLogText, IsThatOfCandumpAndOfVector) {
  RecordedFrame f = framed(0x181, {0x37, 0x0A});
  f.time_ns = 1'057'500'999;
  EXPECT_EQ(candumpLine(f, 0), "(0000000001.057500) can0 181#370A R\n");
  EXPECT_EQ(candumpLine(f, 1'700'000'000'000'000'000), "(1700000001.057500) can0 181#370A R\n");
  EXPECT_EQ(ascLine(f, 1'000'000'000), "   0.057500 1  181             Rx   d 2 37 0A\n");
  f.bus = 1;
  f.sent = true;
  f.frame.extended = true;
  f.frame.id = 0x12345;
  f.frame.remote = true;
  EXPECT_EQ(candumpLine(f, 0), "(0000000001.057500) can1 00012345#R2 T\n");
  EXPECT_EQ(ascLine(f, 0), "   1.057500 2  12345x          Tx   r 2\n");
  EXPECT_EQ(ascHeader(1'700'000'000'123'000'000).substr(0, 34),
            "date Tue Nov 14 22:13:20.123 2023\n");
}

}  // namespace
}  // namespace ballbot
