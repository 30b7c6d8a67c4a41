#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace ballbot {

/// A serial device (or pty) in raw mode that never blocks.
class SerialPort {
 public:
  /// @throw InputError if the device cannot be opened, is no terminal, or another process
  ///        holds its lock; the text says what to do.
  explicit SerialPort(const std::string& path);
  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// Number of bytes read or written, 0 if none can be now, -1 if the device is gone.
  int read(char* out, std::size_t size) noexcept;
  int write(const char* data, std::size_t size) noexcept;
  bool waitReadable(std::chrono::nanoseconds timeout) noexcept;
  int descriptor() const noexcept { return descriptor_; }
  const std::string& path() const noexcept { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

/// Waits until `descriptor` can be read; false after `timeout` or on a signal.
bool pollReadable(int descriptor, std::chrono::nanoseconds timeout) noexcept;

}  // namespace ballbot
