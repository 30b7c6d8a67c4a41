#include "fmi/zip_archive.hpp"

#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <sys/stat.h>
#include <zip.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

/// Of 1 to 9: a fifth larger than with 9, in a quarter of the time.
constexpr zip_uint32_t kCompression = 2;

/// Midnight of 1 January 1980, the earliest time a zip file can hold, in local time as libzip wants
/// it: so the bytes do not tell when the archive was made.
std::time_t zipEpoch() {
  std::tm t{};
  t.tm_year = 80;
  t.tm_mday = 1;
  t.tm_isdst = -1;
  return std::mktime(&t);
}

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, Discard>;

Archive openArchive(const std::string& path) {
  int code = 0;
  Archive archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (archive) return archive;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string why = zip_error_strerror(&error);
  zip_error_fini(&error);
  throw InputError(fmt::format("{}: is not an archive that can be read: {}", path, why));
}

std::string readEntry(zip_t* archive, zip_uint64_t index, const std::string& path) {
  zip_stat_t stat;
  zip_file_t* file = nullptr;
  if (zip_stat_index(archive, index, 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE) ||
      !(file = zip_fopen_index(archive, index, 0))) {
    throw InputError(
        fmt::format("{}: entry {} cannot be read: {}", path, index, zip_strerror(archive)));
  }
  std::string content;
  char buffer[65536];
  zip_int64_t got = 0;
  while ((got = zip_fread(file, buffer, sizeof buffer)) > 0)
    content.append(buffer, static_cast<std::size_t>(got));
  zip_fclose(file);
  if (got < 0 || content.size() != stat.size) {
    throw InputError(fmt::format("{}: '{}' is damaged", path, stat.name));
  }
  return content;
}

}  // namespace

void writeZip(const std::string& path, const std::vector<ZipEntry>& entries) {
  const auto fail = [&](const char* why) {
    throw OutputError(fmt::format("{}: cannot be written: {}", path, why));
  };
  int code = 0;
  Archive archive(zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (!archive) fail("no such folder, or no permission");
  for (const ZipEntry& entry : entries) {
    zip_source_t* source =
        zip_source_buffer(archive.get(), entry.content.data(), entry.content.size(), 0);
    const zip_int64_t index =
        zip_file_add(archive.get(), entry.name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(source);
      fail(zip_strerror(archive.get()));
    }
    const auto i = static_cast<zip_uint64_t>(index);
    zip_set_file_compression(archive.get(), i, ZIP_CM_DEFLATE, kCompression);
    zip_file_set_mtime(archive.get(), i, zipEpoch(), 0);
    const zip_uint32_t mode = entry.executable ? 0100755 : 0100644;
    zip_file_set_external_attributes(archive.get(), i, 0, ZIP_OPSYS_UNIX, mode << 16);
  }
  if (zip_close(archive.get()) != 0) fail(zip_strerror(archive.get()));
  archive.release();  // closed
}

std::string readFromZip(const std::string& path, const std::string& name) {
  const Archive archive = openArchive(path);
  const zip_int64_t index = zip_name_locate(archive.get(), name.c_str(), 0);
  if (index < 0) throw InputError(fmt::format("{}: has no '{}'; is it an FMU?", path, name));
  return readEntry(archive.get(), static_cast<zip_uint64_t>(index), path);
}

bool zipHas(const std::string& path, const std::string& name) {
  return zip_name_locate(openArchive(path).get(), name.c_str(), 0) >= 0;
}

void unpackZip(const std::string& path, const std::string& folder) {
  const Archive archive = openArchive(path);
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(count); ++i) {
    const std::string name = zip_get_name(archive.get(), i, 0);
    const fs::path relative = fs::path(name).lexically_normal();
    if (relative.is_absolute() || relative.begin()->string() == "..") {
      throw InputError(fmt::format("{}: entry '{}' would land outside the folder", path, name));
    }
    const fs::path target = fs::path(folder) / relative;
    if (!name.empty() && name.back() == '/') {
      fs::create_directories(target);
      continue;
    }
    fs::create_directories(target.parent_path());
    const std::string content = readEntry(archive.get(), i, path);
    FILE* file = std::fopen(target.c_str(), "wb");
    const bool written =
        file && std::fwrite(content.data(), 1, content.size(), file) == content.size();
    if ((file && std::fclose(file) != 0) || !written) {
      throw OutputError(fmt::format("{}: cannot be written", target.string()));
    }
  }
}

}  // namespace ballbot
