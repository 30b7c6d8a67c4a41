#include "hil/emulator/pty_bus.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include "core/error.hpp"
#include "hil/serial_port.hpp"

namespace ballbot {
namespace {

constexpr std::size_t kOutputLimit = 1 << 16;  // nobody reads: drop, like an adapter

std::int64_t wallMs() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

void requireNoFile(const std::string& link) {
  struct stat info {};
  if (::lstat(link.c_str(), &info) == 0 && !S_ISLNK(info.st_mode)) {
    throw OutputError(link + ": exists and is no symbolic link; choose another name");
  }
}

void makeLink(const std::string& device, const std::string& link) {
  ::unlink(link.c_str());  // left by somebody who ended without a word
  if (::symlink(device.c_str(), link.c_str()) != 0) {
    throw OutputError(fmt::format("{}: cannot be made: {}", link, std::strerror(errno)));
  }
}

}  // namespace

PtyBus::PtyBus(std::string link, bool flexible) : adapter_(flexible) {
  if (!link.empty()) {
    requireNoFile(link);
    claim_.emplace(link);
  }
  master_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  std::array<char, 128> name{};
  if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0 ||
      ::ptsname_r(master_, name.data(), name.size()) != 0) {
    const std::string reason = std::strerror(errno);
    if (master_ >= 0) ::close(master_);
    throw OutputError("cannot make a pseudo terminal: " + reason);
  }
  device_ = name.data();
  // Held open, so that hosts may come and go; raw, so that nothing is echoed meanwhile.
  slave_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios settings{};
  ::tcgetattr(slave_, &settings);
  ::cfmakeraw(&settings);
  ::tcsetattr(slave_, TCSANOW, &settings);
  if (link.empty()) return;
  try {
    makeLink(device_, link);
  } catch (...) {
    ::close(slave_);
    ::close(master_);
    throw;
  }
  link_ = std::move(link);
}

PtyBus::~PtyBus() {
  // What somebody else has put there meanwhile is theirs.
  std::array<char, 128> target{};
  if (!link_.empty() && ::readlink(link_.c_str(), target.data(), target.size() - 1) > 0 &&
      device_ == target.data()) {
    ::unlink(link_.c_str());
  }
  ::close(slave_);
  ::close(master_);
}

bool PtyBus::send(const CanFrame& frame) noexcept {
  if (!isValid(frame) || output_.size() > kOutputLimit) {
    ++counters_.refused;
    return false;
  }
  adapter_.show(frame, wallMs(), output_);
  ++counters_.sent;
  flush();
  return true;
}

void PtyBus::flush() noexcept {
  while (!output_.empty()) {
    const ssize_t n = ::write(master_, output_.data(), output_.size());
    if (n <= 0) return;
    output_.erase(0, static_cast<std::size_t>(n));
  }
}

void PtyBus::read() {
  std::array<char, 4096> bytes;
  CanFrame frame;
  for (ssize_t n; (n = ::read(master_, bytes.data(), bytes.size())) > 0;) {
    for (ssize_t i = 0; i < n; ++i) {
      if (adapter_.take(bytes[static_cast<std::size_t>(i)], output_, frame)) {
        arrived_.push_back(frame);
      }
    }
    if (output_.size() > kOutputLimit) output_.clear();  // replies nobody reads
  }
  flush();
}

bool PtyBus::receive(CanFrame& out) noexcept {
  if (arrived_.empty()) read();
  if (arrived_.empty()) return false;
  out = arrived_.front();
  arrived_.pop_front();
  ++counters_.received;
  return true;
}

bool PtyBus::waitReadable(std::chrono::nanoseconds timeout) noexcept {
  flush();
  return !arrived_.empty() || pollReadable(master_, timeout);
}

}  // namespace ballbot
