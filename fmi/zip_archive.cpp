#include "fmi/zip_archive.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <sys/stat.h>
#include <zip.h>

#include "core/error.hpp"
#include "core/whole_file.hpp"

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

/// An open entry. Its length is what the archive says; more than that never comes out of it.
class Entry {
 public:
  Entry(zip_t* archive, zip_uint64_t index, const std::string& path) : path_(path) {
    zip_stat_t stat;
    const bool known =
        zip_stat_index(archive, index, 0, &stat) == 0 && (stat.valid & ZIP_STAT_SIZE) != 0;
    file_.reset(known ? zip_fopen_index(archive, index, 0) : nullptr);
    if (!file_) {
      throw InputError(
          fmt::format("{}: entry {} cannot be read: {}", path, index, zip_strerror(archive)));
    }
    size_ = left_ = stat.size;
    const char* name = zip_get_name(archive, index, ZIP_FL_ENC_GUESS);
    name_ = name ? name : "";
  }
  std::uint64_t size() const { return size_; }

  /// Hands the content to `take`, piece by piece. @throw InputError if it is damaged.
  template <typename Take>
  void read(Take&& take) {
    std::vector<char> buffer(65536);
    zip_int64_t got = 0;
    while ((got = zip_fread(file_.get(), buffer.data(), buffer.size())) > 0) {
      if (static_cast<std::uint64_t>(got) > left_) break;
      left_ -= static_cast<std::uint64_t>(got);
      take(buffer.data(), static_cast<std::size_t>(got));
    }
    if (got != 0 || left_ != 0) throw InputError(fmt::format("{}: '{}' is damaged", path_, name_));
  }

 private:
  struct Close {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
  };
  const std::string& path_;
  std::string name_;
  std::unique_ptr<zip_file_t, Close> file_;
  std::uint64_t size_ = 0, left_ = 0;
};

std::string readableSize(std::uint64_t bytes) {
  return bytes < (std::uint64_t{10} << 20) ? fmt::format("{} bytes", bytes)
                                           : fmt::format("{} MiB", bytes >> 20);
}

/// Where an entry goes. @throw InputError if that is no place in the folder.
fs::path placeOf(const std::string& name, const std::string& path) {
  const fs::path place = fs::path(name).lexically_normal();
  if (name.empty() || place == ".") {
    throw InputError(fmt::format("{}: has an entry without a name", path));
  }
  if (place.is_absolute() || *place.begin() == "..") {
    throw InputError(fmt::format("{}: entry '{}' would land outside the folder", path, name));
  }
  return place;
}

/// Makes a folder of the archive. A file of its own may stand in the way, or its name be too long.
void makeFolder(const fs::path& folder, const std::string& path) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder)) return;
  const std::string why = error ? error.message() : "a file has that name";
  const std::string text =
      fmt::format("{}: cannot be unpacked: {}: {}", path, folder.string(), why);
  if (error == std::errc::no_space_on_device || error == std::errc::permission_denied ||
      error == std::errc::read_only_file_system) {
    throw OutputError(text);
  }
  throw InputError(text);
}

bool mayBeExecuted(zip_t* archive, zip_uint64_t index) {
  zip_uint8_t system = 0;
  zip_uint32_t attributes = 0;
  return zip_file_get_external_attributes(archive, index, 0, &system, &attributes) == 0 &&
         system == ZIP_OPSYS_UNIX && (attributes >> 16 & S_IXUSR) != 0;
}

void writeEntry(Entry& entry, const fs::path& target, bool executable, const std::string& path) {
  const auto close = [](FILE* f) { std::fclose(f); };
  std::unique_ptr<FILE, decltype(close)> file(std::fopen(target.c_str(), "wb"), close);
  if (!file) {
    const std::string text =
        fmt::format("{}: cannot be unpacked: {}: {}", path, target.string(), std::strerror(errno));
    if (errno == EISDIR || errno == ENAMETOOLONG || errno == ENOTDIR) throw InputError(text);
    throw OutputError(text);
  }
  const auto full = [&] {
    return OutputError(
        fmt::format("{}: cannot be written: {}", target.string(), std::strerror(errno)));
  };
  entry.read([&](const char* bytes, std::size_t size) {
    if (std::fwrite(bytes, 1, size, file.get()) != size) throw full();
  });
  if (executable) ::fchmod(::fileno(file.get()), 0755);
  if (std::fclose(file.release()) != 0) throw full();
}

}  // namespace

// Made in memory: whoever is interrupted leaves nothing half made beside the file.
void writeZip(const std::string& path, const std::vector<ZipEntry>& entries) {
  const auto fail = [&](const char* why) {
    throw OutputError(fmt::format("{}: cannot be written: {}", path, why));
  };
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* bytes = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (bytes == nullptr) fail("no memory");
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> kept(bytes, zip_source_free);
  zip_source_keep(bytes);  // the archive frees its own hold
  Archive archive(zip_open_from_source(bytes, ZIP_TRUNCATE, &error));
  if (!archive) {
    zip_source_free(bytes);
    fail(zip_error_strerror(&error));
  }
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
  if (zip_source_open(bytes) != 0) fail("it cannot be read back");
  zip_stat_t stat;
  zip_source_stat(bytes, &stat);
  std::string content(stat.size, '\0');
  const bool whole = zip_source_read(bytes, content.data(), content.size()) ==
                     static_cast<zip_int64_t>(content.size());
  zip_source_close(bytes);
  if (!whole) fail("it cannot be read back");
  if (const int why = writeWholeFile(path, content)) fail(std::strerror(why));
}

std::string readFromZip(const std::string& path, const std::string& name, std::uint64_t longest) {
  const Archive archive = openArchive(path);
  const zip_int64_t index = zip_name_locate(archive.get(), name.c_str(), 0);
  if (index < 0) throw InputError(fmt::format("{}: has no '{}'; is it an FMU?", path, name));
  Entry entry(archive.get(), static_cast<zip_uint64_t>(index), path);
  if (entry.size() > longest) {
    throw InputError(fmt::format("{}: '{}' unpacks to {}, must be {} at most", path, name,
                                 readableSize(entry.size()), readableSize(longest)));
  }
  std::string content;
  entry.read([&](const char* bytes, std::size_t size) { content.append(bytes, size); });
  return content;
}

bool zipHas(const std::string& path, const std::string& name) {
  return zip_name_locate(openArchive(path).get(), name.c_str(), 0) >= 0;
}

void unpackZip(const std::string& path, const std::string& folder, const UnpackLimits& limits) {
  const Archive archive = openArchive(path);
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  if (count > limits.entries) {
    throw InputError(
        fmt::format("{}: holds {} files, must be {} at most", path, count, limits.entries));
  }
  std::uint64_t left = limits.bytes;
  for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(count); ++i) {
    const char* raw_name = zip_get_name(archive.get(), i, 0);
    const std::string name = raw_name ? raw_name : "";
    const fs::path target = fs::path(folder) / placeOf(name, path);
    if (name.back() == '/') {
      makeFolder(target, path);
      continue;
    }
    makeFolder(target.parent_path(), path);
    Entry entry(archive.get(), i, path);
    if (entry.size() > left) {
      throw InputError(fmt::format("{}: unpacks to more than {}, which it must not", path,
                                   readableSize(limits.bytes)));
    }
    left -= entry.size();
    writeEntry(entry, target, mayBeExecuted(archive.get(), i), path);
  }
}

}  // namespace ballbot
