#include "hil/emulator/link_claim.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

/// "(process 1234)", as the one that holds the lock has written it; "" if it has not yet.
std::string holderOf(int descriptor) {
  std::array<char, 16> text{};
  if (::pread(descriptor, text.data(), text.size() - 1, 0) <= 0) return "";
  return fmt::format(" (process {})", std::atol(text.data()));
}

/// Whether `path` still names the file that was opened: its owner may have taken it away.
bool isStill(const std::string& path, int descriptor) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

LinkClaim::LinkClaim(const std::string& link) : path_(link + ".lock") {
  for (;;) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor_ < 0) {
      throw OutputError(fmt::format("{}: cannot be made: {}", path_, std::strerror(errno)));
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const std::string holder = holderOf(descriptor_);
      ::close(descriptor_);
      throw InputError(fmt::format(
          "{}: another `ballbot drives`{} serves this link. End that one first, or give this one "
          "links of its own: --set emulator.buses.0.link=... and buses.0.address=slcan:...",
          link, holder));
    }
    if (isStill(path_, descriptor_)) break;
    ::close(descriptor_);
  }
  const std::string number = fmt::format("{}\n", ::getpid());
  if (::ftruncate(descriptor_, 0) != 0 ||
      ::pwrite(descriptor_, number.data(), number.size(), 0) < 0) {
    const std::string reason = std::strerror(errno);
    ::close(descriptor_);
    throw OutputError(fmt::format("{}: cannot be written: {}", path_, reason));
  }
}

LinkClaim::~LinkClaim() {
  ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace ballbot
