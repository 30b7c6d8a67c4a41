// Data sheets of vendors: read as CiA 306 says, refused with file and line, and never believed.
#include "hil/eds/data_sheet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "hil/emulator/drive_node.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

const char* const kSheet =
    "\xEF\xBB\xBF; a comment\r\n"
    "[DeviceInfo]\r\n"
    "VendorName = Some Vendor\r\n"
    "vendornumber=0x1F\r\n"
    "ProductNumber=010\r\n"
    "BaudRate_500=1\r\n"
    "BaudRate_1000=0\r\n"
    "Granularity=8\r\n"
    "[DummyUsage]\r\n"
    "Dummy0007=1\r\n"
    "[DeviceComissioning]\r\n"
    "NodeID=5\r\n"
    "[OptionalObjects]\r\n"
    "SupportedObjects=4\r\n"
    "1=0x1800\r\n"
    "2=0x6071\r\n"
    "3=0x2100\r\n"
    "4=0x1008\r\n"
    "[1800]\r\nParameterName=TPDO\r\nObjectType=9\r\nSubNumber=2\r\n"
    "[1800sub1]\r\nDataType=7\r\nAccessType=RW\r\nDefaultValue= 0x40000180 + $NODEID\r\n"
    "[1800sub0]\r\nDataType=5\r\nAccessType=ro\r\nDefaultValue=2\r\n"
    "[6071]\r\nParameterName=Target torque\r\nDataType=0x0003\r\nAccessType=rww\r\n"
    "LowLimit=0x8000\r\nHighLimit=1000\r\nPDOMapping=1\r\nParameterValue=-2\r\n"
    "[2100]\r\nParameterName=Gains\r\nObjectType=8\r\nCompactSubObj=3\r\nDataType=6\r\n"
    "AccessType=rw\r\nPDOMapping=0\r\n"
    "[1008]\r\nDataType=9\r\nAccessType=const\r\nDefaultValue=0xyz is a name\r\n";

TEST(DataSheet, IsReadAsItIsWritten) {
  const DataSheet sheet = DataSheet::parse(kSheet, "some.dcf");
  EXPECT_EQ(sheet.vendor(), "Some Vendor");
  EXPECT_EQ(sheet.vendorNumber(), 31);
  EXPECT_EQ(sheet.productNumber(), 8) << "octal";
  EXPECT_TRUE(sheet.hasRate(500));
  EXPECT_FALSE(sheet.hasRate(1000));
  EXPECT_TRUE(sheet.hasDummy(7));
  EXPECT_FALSE(sheet.hasDummy(5));
  EXPECT_EQ(sheet.node(), 5);
  ASSERT_NE(sheet.find(0x1800, 1), nullptr);
  EXPECT_EQ(sheet.find(0x1800, 1)->preset->at(5), 0x40000185);
  const EdsEntry& torque = *sheet.find(0x6071, 0);
  EXPECT_EQ(torque.low->value, -32768) << "0x8000 of an INTEGER16";
  EXPECT_EQ(torque.high->value, 1000);
  EXPECT_EQ(torque.configured->value, -2);
  EXPECT_EQ(torque.line, 31);
  EXPECT_TRUE(torque.inReceivePdo());
  EXPECT_FALSE(torque.inTransmitPdo()) << "rww is for RPDOs";
  EXPECT_EQ(sheet.find(0x2100, 3)->bits(), 16);
  EXPECT_EQ(sheet.find(0x2100, 0)->preset->value, 3);
  EXPECT_EQ(sheet.find(0x2100, 4), nullptr);
  EXPECT_EQ(sheet.find(0x1008, 0)->bits(), 0);
}

TEST(DataSheet, RefusesWithFileLineAndWhatWasExpected) {
  struct Wrong {
    const char *from, *to, *words;
  };
  for (const Wrong& w : {
           Wrong{"4=0x1008", "4=0x1009",
                 "some.dcf:18: object 1009 is listed, but there is no "
                 "section [1009]"},
           Wrong{"SupportedObjects=4", "SupportedObjects=5",
                 "some.dcf:14: [OptionalObjects] promises 5 objects, has no number 5"},
           Wrong{"SupportedObjects=4", "SupportedObjects=99999999999",
                 "SupportedObjects is 99999999999, must be 0 to 65536"},
           Wrong{"LowLimit=0x8000", "LowLimit=70000",
                 "LowLimit is 70000, which INTEGER16 cannot hold"},
           Wrong{"DataType=0x0003", "DataType=three",
                 "DataType is 'three', must be a whole number such as 14, 0x1F or $NODEID+0x180"},
           Wrong{"AccessType=rww", "AccessType=yes",
                 "AccessType is 'yes', must be ro, wo, rw, rwr, rww or const"},
           Wrong{"AccessType=rww\r\n", "", "some.dcf:31: [6071] has no AccessType"},
           Wrong{"NodeID=5", "NodeID=0", "NodeID is 0, must be 1 to 127"},
           Wrong{"[1800sub0]", "[1800sub1]", "section [1800sub1] is there already, at line 23"},
           Wrong{"[2100]", "[2100", "'[2100' has no closing bracket"},
           Wrong{"[2100]", "2100", "'2100' is neither [section] nor key=value"},
           Wrong{"PDOMapping=1", "PDOMapping=0x7FFFFFFFFFFFFFFFF", "PDOMapping is"},
           Wrong{"[1800sub0]", "[1900sub0]",
                 "[1900sub0] describes a part of object 1900, which is not listed"},
           Wrong{"; a comment\r\n", "name=value\r\n", "stands before the first [section]"},
       }) {
    std::string text = kSheet;
    const std::size_t at = text.find(w.from);
    ASSERT_NE(at, std::string::npos) << w.from;
    text.replace(at, std::string(w.from).size(), w.to);
    try {
      DataSheet::parse(text, "some.dcf");
      FAIL() << "took " << w.to;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(w.words));
    }
  }
  EXPECT_THROW(DataSheet::parse("", "empty.eds"), InputError);
  EXPECT_THROW(DataSheet::parse("[a]\n" + std::string(5000, 'x') + "=1\n", "long.eds"), InputError);
  EXPECT_THROW(DataSheet::read("/no/such.eds"), InputError);
}

// The reader and the emulated drive, written apart, agree about every object.
TEST(DataSheet, OfTheEmulatedDriveSaysWhatItsDictionarySays) {
  const DataSheet sheet =
      DataSheet::read(std::string(BALLBOT_SOURCE_DIR) + "/configs/hil/ballbot_drive.eds");
  EmulatedDriveParameters p;
  p.node = 9;
  const DriveNode drive(p);
  EXPECT_EQ(sheet.entryCount(), drive.dictionary().entries().size());
  for (const auto& [key, entry] : drive.dictionary().entries()) {
    const EdsEntry* e = sheet.find(key.first, key.second);
    ASSERT_NE(e, nullptr) << key.first;
    EXPECT_EQ(e->bits(), 8 * sizeOf(entry.type));
    EXPECT_EQ(e->mappable, entry.mappable);
    EXPECT_EQ(e->readable(), entry.readable());
    EXPECT_EQ(e->writable(), entry.writable());
    if (entry.type != OdType::kText) {
      EXPECT_EQ(e->preset->at(9), entry.initial);
    }
    EXPECT_EQ(e->low.has_value(), entry.low.has_value());
  }
}

}  // namespace
}  // namespace ballbot
