// EDS and DCF files of strangers, mutated, read under sanitizers (tests/fuzz).
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "hil/eds/data_sheet.hpp"
#include "tests/hil/support/random_bytes.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

const char* const kDevice =
    "[DeviceInfo]\nVendorNumber=0x1F\nBaudRate_1000=1\nGranularity=8\n"
    "[DummyUsage]\nDummy0007=1\n[DeviceComissioning]\nNodeID=5\n"
    "[OptionalObjects]\nSupportedObjects=3\n1=0x1800\n2=0x6071\n3=0x2100\n"
    "[1800]\nObjectType=9\nSubNumber=2\n"
    "[1800sub1]\nDataType=7\nAccessType=rw\nDefaultValue=$NODEID+0x40000180\n"
    "[6071]\nDataType=3\nAccessType=rww\nLowLimit=0x8000\nHighLimit=1000\nPDOMapping=1\n"
    "[2100]\nObjectType=8\nCompactSubObj=3\nDataType=6\nAccessType=rw\nPDOMapping=0\n";

std::string textOf(const std::string& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// Whatever a file holds, it is a sheet or an error in words, within the blink of an eye.
TEST(DataSheet, TakesOrRefusesAnything) {
  const std::string sheets[] = {
      kDevice,
      textOf(std::string(BALLBOT_SOURCE_DIR) + "/configs/hil/ballbot_imu.eds").substr(0, 6000)};
  RandomBytes random(11);
  int taken = 0, refused = 0;
  for (int i = 0; i < 6000; ++i) {
    std::string text = sheets[i % 2];
    for (int changes = 1 + static_cast<int>(random.below(3)); changes > 0; --changes) {
      const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
      switch (random.below(4)) {
        case 0:
          text[at] = static_cast<char>(random.byte());
          break;
        case 1:
          text.erase(at, 1 + random.below(20));
          break;
        case 2:
          text.insert(at, text.substr(random.below(static_cast<std::uint32_t>(at + 1)), 30));
          break;
        default:
          text.insert(at, "9999999999");
      }
    }
    try {
      DataSheet::parse(text, "fuzz.eds");
      ++taken;
    } catch (const InputError& e) {
      ASSERT_THAT(e.what(), HasSubstr("fuzz.eds"));
      ++refused;
    }
  }
  EXPECT_GT(taken, 300);
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace ballbot
