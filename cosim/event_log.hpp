#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "messages/wire.hpp"

namespace ballbot {

/// Writes an LCM event log, readable by LCM's own tools, with simulated time in place of the wall
/// clock and event numbers from 0: the same events give the same bytes.
class EventLogWriter {
 public:
  /// @throw OutputError if the file cannot be created.
  explicit EventLogWriter(const std::string& path);
  ~EventLogWriter();
  EventLogWriter(const EventLogWriter&) = delete;
  EventLogWriter& operator=(const EventLogWriter&) = delete;

  /// @throw OutputError if the disk is full or the write failed; the file then ends with the last
  ///        event that fitted as a whole.
  void write(SimTime time, const char* channel, const Bytes& data);
  /// Hands everything written so far to the operating system, so that it survives this process.
  void flush();
  void close();
  std::int64_t bytesWritten() const { return written_ + static_cast<std::int64_t>(buffer_.size()); }
  /// Of the bytes in the file, once it is closed: logDigest() of it, as long as nobody changes it.
  std::string digest() const { return digest_.hex(); }

 private:
  [[noreturn]] void giveUp(std::size_t done, int error);

  std::string path_;
  int file_ = -1;
  std::int64_t number_ = 0;
  std::int64_t written_ = 0;          // bytes in the file
  Digest digest_;                     // of the bytes in the file
  std::vector<std::uint8_t> buffer_;  // whole events
  std::vector<std::size_t> ends_;     // where each ends
};

/// Digest of a file's bytes. @throw InputError if it cannot be read
std::string logDigest(const std::string& path);

}  // namespace ballbot
