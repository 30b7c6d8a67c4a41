#include "fmi/zip_archive.hpp"

#include <filesystem>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "tests/fmi/small_fmus.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class ZipArchive : public ::testing::Test {
 protected:
  std::string archive(const std::vector<ZipEntry>& entries) {
    writeZip(file_, entries);
    return file_;
  }
  std::string refusal(const std::vector<ZipEntry>& entries, const UnpackLimits& limits = {}) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    try {
      unpackZip(archive(entries), folder_, limits);
    } catch (const InputError& e) {
      return e.what();
    }
    return "not refused";
  }
  std::string folder_ = smallFmuFolder() + "/unpacked", file_ = smallFmuFolder() + "/test.zip";
};

TEST_F(ZipArchive, FilesThatMayBeExecutedStaySo) {
  refusal({{"resources/helper.sh", "#!/bin/sh\n", true}, {"resources/data.txt", "1", false}});
  const auto executable = [&](const char* name) {
    return (fs::status(folder_ + name).permissions() & fs::perms::owner_exec) != fs::perms::none;
  };
  EXPECT_TRUE(executable("/resources/helper.sh"));
  EXPECT_FALSE(executable("/resources/data.txt"));
}

TEST_F(ZipArchive, WhatCannotBeAFileInTheFolderIsRefused) {
  EXPECT_THAT(refusal({{"../evil", ""}}), HasSubstr("'../evil' would land outside the folder"));
  EXPECT_THAT(refusal({{"a/../../evil", ""}}), HasSubstr("would land outside the folder"));
  EXPECT_THAT(refusal({{"/evil", ""}}), HasSubstr("would land outside the folder"));
  EXPECT_THAT(refusal({{".", ""}}), HasSubstr("an entry without a name"));
  EXPECT_THAT(refusal({{"a", "1"}, {"a/b", "2"}}), HasSubstr("cannot be unpacked"));
  EXPECT_THAT(refusal({{"a/b", "2"}, {"a", "1"}}), HasSubstr("cannot be unpacked"));
  EXPECT_THAT(refusal({{std::string(300, 'n'), "1"}}), HasSubstr("cannot be unpacked"));
}

TEST_F(ZipArchive, HoldsItsLimits) {
  const std::vector<ZipEntry> three = {{"a", "1234"}, {"b", "1234"}, {"c", "1234"}};
  EXPECT_EQ(refusal(three, {12, 3}), "not refused");
  EXPECT_THAT(refusal(three, {11, 3}), HasSubstr("unpacks to more than 11 bytes"));
  EXPECT_THAT(refusal(three, {12, 2}), HasSubstr("holds 3 files, must be 2 at most"));
  EXPECT_EQ(readFromZip(archive(three), "a", 4), "1234");
  EXPECT_THROW(readFromZip(archive(three), "a", 3), InputError);
}

}  // namespace
}  // namespace ballbot
