#include "cosim/event_log.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr std::uint32_t kSyncWord = 0xEDA1DA01;
constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

template <typename T>
void appendBigEndian(std::vector<std::uint8_t>& out, T value) {
  for (int shift = 8 * static_cast<int>(sizeof value) - 8; shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

}  // namespace

EventLogWriter::EventLogWriter(const std::string& path)
    : path_(path), file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0) {
    throw OutputError(fmt::format("{}: cannot be created: {}", path, std::strerror(errno)));
  }
  buffer_.reserve(2 * kBufferBytes);
}

EventLogWriter::~EventLogWriter() {
  if (file_ < 0) return;
  try {
    close();
  } catch (const OutputError&) {
    // Nobody is left to hear it; what the disk took is readable.
  }
}

void EventLogWriter::write(SimTime time, const char* channel, const Bytes& data) {
  const std::size_t channel_size = std::strlen(channel);
  appendBigEndian(buffer_, kSyncWord);
  appendBigEndian(buffer_, number_++);
  appendBigEndian(buffer_, toNs(time) / 1000);
  appendBigEndian(buffer_, static_cast<std::uint32_t>(channel_size));
  appendBigEndian(buffer_, static_cast<std::uint32_t>(data.size()));
  buffer_.insert(buffer_.end(), channel, channel + channel_size);
  buffer_.insert(buffer_.end(), data.begin(), data.end());
  ends_.push_back(buffer_.size());
  if (buffer_.size() >= kBufferBytes) flush();
}

void EventLogWriter::flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t count = ::write(file_, buffer_.data() + done, buffer_.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) giveUp(done, errno);
    done += static_cast<std::size_t>(count);
  }
  written_ += static_cast<std::int64_t>(done);
  digest_.add(buffer_.data(), done);
  buffer_.clear();
  ends_.clear();
}

// The disk took `done` bytes: cuts the file after the last whole event of them.
void EventLogWriter::giveUp(std::size_t done, int error) {
  std::size_t whole = 0;
  for (const std::size_t end : ends_) {
    if (end <= done) whole = end;
  }
  written_ += static_cast<std::int64_t>(whole);
  if (::ftruncate(file_, written_) != 0) {
    // No regular file; a reader stops at the cut by itself.
  }
  ::close(file_);
  file_ = -1;
  buffer_.clear();
  ends_.clear();
  throw OutputError(
      fmt::format("{}: cannot be written: {}. The first {} bytes of the log are there "
                  "and readable.",
                  path_, std::strerror(error), written_));
}

void EventLogWriter::close() {
  if (file_ < 0) return;
  flush();
  const int file = file_;
  file_ = -1;
  if (::close(file) != 0) {
    throw OutputError(fmt::format("{}: cannot be completed: {}", path_, std::strerror(errno)));
  }
}

std::string logDigest(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  Digest digest;
  std::vector<char> block(kBufferBytes);
  while (file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    digest.add(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.eof()) throw InputError(fmt::format("{}: cannot be read to its end", path));
  return digest.hex();
}

}  // namespace ballbot
