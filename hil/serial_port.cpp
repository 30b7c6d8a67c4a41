#include "hil/serial_port.hpp"

#include <cerrno>
#include <cstring>
#include <ctime>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <termios.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

int outcome(ssize_t n, int error) noexcept {
  if (n > 0) return static_cast<int>(n);
  if (n < 0 && (error == EAGAIN || error == EWOULDBLOCK || error == EINTR)) return 0;
  return -1;
}

[[noreturn]] void refuse(const std::string& path, const std::string& what,
                         const std::string& remedy) {
  throw InputError(fmt::format("{}: {}. {}", path, what, remedy));
}

}  // namespace

SerialPort::SerialPort(const std::string& path) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) {
    const int error = errno;
    refuse(path, fmt::format("cannot be opened: {}", std::strerror(error)),
           error == EACCES ? "Is your user in the group 'dialout'?"
                           : "Is the adapter plugged in, or `ballbot drives` running?");
  }
  termios settings{};
  if (::tcgetattr(descriptor_, &settings) != 0) {
    ::close(descriptor_);
    refuse(path, "is no serial device", "Give the adapter's tty, e.g. /dev/ttyACM0");
  }
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  ::cfsetspeed(&settings, B3000000);  // USB adapters ignore it, real UARTs should be this fast
  if (::tcsetattr(descriptor_, TCSANOW, &settings) != 0) {
    const std::string reason = std::strerror(errno);
    ::close(descriptor_);
    refuse(path, "cannot be set to raw mode: " + reason, "Is it a serial device?");
  }
  // Two masters on one bus would be dangerous. The lock ends with the process, however it ends.
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor_);
    refuse(path, "is in use by another process", "End that one first");
  }
}

SerialPort::~SerialPort() { ::close(descriptor_); }

int SerialPort::read(char* out, std::size_t size) noexcept {
  const ssize_t n = ::read(descriptor_, out, size);
  return outcome(n, errno);
}

int SerialPort::write(const char* data, std::size_t size) noexcept {
  const ssize_t n = ::write(descriptor_, data, size);
  return outcome(n, errno);
}

bool SerialPort::waitReadable(std::chrono::nanoseconds timeout) noexcept {
  return pollReadable(descriptor_, timeout);
}

bool pollReadable(int descriptor, std::chrono::nanoseconds timeout) noexcept {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t ns = timeout.count() > 0 ? timeout.count() : 0;
  const timespec wait{ns / kSecond, ns % kSecond};
  pollfd entry{descriptor, POLLIN, 0};
  // A signal is no answer and no end of waiting: who waits looks again, and at its own deadline.
  const int ready = ::ppoll(&entry, 1, &wait, nullptr);
  return ready > 0 || (ready < 0 && errno == EINTR);
}

}  // namespace ballbot
