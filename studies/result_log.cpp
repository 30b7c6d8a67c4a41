#include "studies/result_log.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "experiment/text_file.hpp"

namespace ballbot {
namespace {

constexpr std::size_t kChecksumDigits = 16;

std::string checksum(const std::string& record) {
  return fmt::format("{:016x}", hash64(record.data(), record.size()));
}

}  // namespace

ResultLog::ResultLog(const std::string& path)
    : path_(path), file_(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644)) {
  if (file_ < 0)
    throw OutputError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  // A line that was cut off must not swallow the next one.
  struct stat facts {};
  char last = '\n';
  if (::fstat(file_, &facts) == 0 && facts.st_size > 0) {
    if (::pread(file_, &last, 1, facts.st_size - 1) != 1) last = '\0';
  }
  if (last != '\n' && ::write(file_, "\n", 1) != 1) {
    throw OutputError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  }
}

ResultLog::~ResultLog() { ::close(file_); }

void ResultLog::append(const std::string& record) {
  const std::string line = checksum(record) + " " + record + "\n";
  // One write: with O_APPEND lines of several writers do not mix.
  const ssize_t written = ::write(file_, line.data(), line.size());
  if (written != static_cast<ssize_t>(line.size()) || ::fdatasync(file_) != 0) {
    throw OutputError(
        fmt::format("{}: cannot be written: {}. Is there room?", path_,
                    written < 0 ? std::strerror(errno) : "the disk took only a part"));
  }
}

ResultLogContent readResultLog(const std::string& path) {
  ResultLogContent out;
  const std::string text = readTextFile(path);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    const std::string line = text.substr(begin, end - begin);
    begin = end == std::string::npos ? text.size() : end + 1;
    if (line.empty()) continue;
    if (line.size() > kChecksumDigits && line[kChecksumDigits] == ' ' &&
        line.substr(0, kChecksumDigits) == checksum(line.substr(kChecksumDigits + 1))) {
      out.records.push_back(line.substr(kChecksumDigits + 1));
    } else {
      ++out.damaged;
    }
  }
  return out;
}

}  // namespace ballbot
