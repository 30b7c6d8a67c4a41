// The data sheet in the repository is the object dictionary: read back entry by entry, and every
// object it promises is there over SDO with the access it promises.
#include "hil/emulator/eds_file.hpp"

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "core/yaml_file.hpp"
#include "hil/emulator/drive_node.hpp"
#include "hil/emulator/emulator_config.hpp"
#include "hil/emulator/imu_node.hpp"
#include "tests/hil/support/sdo_dialogue.hpp"

namespace ballbot {
namespace {

using Section = std::map<std::string, std::string>;
const std::string kFolder = std::string(BALLBOT_SOURCE_DIR) + "/configs/hil/";

std::string fileText(const std::string& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::map<std::string, Section> parsed(const std::string& path) {
  std::map<std::string, Section> sections;
  std::istringstream in(fileText(path));
  std::string line, name;
  while (std::getline(in, line)) {
    const std::size_t equals = line.find('=');
    if (!line.empty() && line[0] == '[')
      name = line.substr(1, line.size() - 2);
    else if (equals != std::string::npos)
      sections[name][line.substr(0, equals)] = line.substr(equals + 1);
  }
  return sections;
}

std::int64_t number(std::string text, int node) {
  std::int64_t base = 0;
  const std::string prefix = "$NODEID+";
  if (text.rfind(prefix, 0) == 0) {
    base = node;
    text = text.substr(prefix.size());
  }
  return base + std::strtoll(text.c_str(), nullptr, 0);
}

/// @param node any but the one the file was made with, so that $NODEID is put to the test
void expectServed(CanopenNode& node, const std::string& path) {
  node.powerOn();
  SdoDialogue talk(node);
  const auto sections = parsed(path);
  int checked = 0;
  for (const auto& [name, s] : sections) {
    if (s.count("DataType") == 0) continue;
    const auto index =
        static_cast<std::uint16_t>(std::strtoul(name.substr(0, 4).c_str(), nullptr, 16));
    const auto sub = static_cast<std::uint8_t>(
        name.size() > 4 ? std::strtoul(name.substr(7).c_str(), nullptr, 16) : 0);
    const bool live = index == 0x6041;  // a measured value, not a default
    if (s.at("DataType") == "0x0009") {
      EXPECT_EQ(talk.readText(index), s.at("DefaultValue")) << name;
    } else {
      const auto value = talk.read(index, sub);
      ASSERT_TRUE(value) << name;
      const std::size_t bits = 8 * talk.client().size();
      const std::int64_t mask = bits == 64 ? -1 : (std::int64_t{1} << bits) - 1;
      if (!live) {
        EXPECT_EQ(*value, number(s.at("DefaultValue"), node.id()) & mask) << name;
      }
    }
    const std::size_t size = talk.client().size();
    const auto held = talk.read(index, sub).value_or(0);
    const std::uint32_t code =
        talk.write(index, sub, held, s.at("DataType") == "0x0009" ? 4 : size);
    if (s.at("AccessType") != "rw") {
      EXPECT_EQ(code, 0x06010002U) << name << " is read only";
    } else {
      EXPECT_NE(code, 0x06010002U) << name << " can be written";
    }
    ++checked;
  }
  EXPECT_EQ(checked, static_cast<int>(node.dictionary().entries().size())) << "none left out";
}

TEST(EdsFile, OfTheDriveIsItsObjectDictionary) {
  DriveNode made({});
  EXPECT_EQ(fileText(kFolder + "ballbot_drive.eds"),
            edsText(made.dictionary(), 1, "ballbot emulated drive", "ballbot_drive.eds"));
  EmulatedDriveParameters p;
  p.node = 9;
  DriveNode drive(p);
  expectServed(drive, kFolder + "ballbot_drive.eds");
}

TEST(EdsFile, OfTheImuIsItsObjectDictionary) {
  ImuNode made(7, 4.79e-3, 1.065e-3);
  EXPECT_EQ(fileText(kFolder + "ballbot_imu.eds"),
            edsText(made.dictionary(), 7, "ballbot emulated IMU", "ballbot_imu.eds"));
  ImuNode imu(12, 4.79e-3, 1.065e-3);
  expectServed(imu, kFolder + "ballbot_imu.eds");
}

// The drives of the invented vendors, as the emulator's section of their bench files says them.
TEST(EdsFile, OfTheVendorsAreTheDrivesThatTheirBenchFilesDescribe) {
  struct Vendor {
    const char *folder, *file, *vendor, *product;
  };
  for (const Vendor& v : {Vendor{"quistal", "quistal_q20.eds", "Quistal", "Quistal Q20"},
                          Vendor{"nebelhorn", "nebelhorn_n4.eds", "Nebelhorn", "Nebelhorn N4"}}) {
    const std::string folder = kFolder + "vendors/" + v.folder + "/";
    EmulatedDriveParameters p =
        readEmulatorConfig(loadYamlFile(folder + "bench.yaml")).drives.front();
    DriveNode made(p);
    EXPECT_EQ(fileText(folder + v.file),
              edsText(made.dictionary(), p.node, v.product, v.file, v.vendor));
    p.node = 9;
    p.sdo_delay_ns = 0;
    DriveNode drive(p);
    expectServed(drive, folder + v.file);
  }
}

TEST(EdsFile, CountsItsObjects) {
  const auto s = parsed(kFolder + "ballbot_drive.eds");
  EXPECT_EQ(s.at("DeviceInfo").at("NrOfRXPDO"), "4");
  EXPECT_EQ(s.at("DeviceInfo").at("NrOfTXPDO"), "4");
  EXPECT_EQ(s.at("MandatoryObjects").at("SupportedObjects"), "3");
  EXPECT_EQ(s.at("1600").at("SubNumber"), "9");
}

}  // namespace
}  // namespace ballbot
