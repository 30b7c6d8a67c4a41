#include "tools/standard_streams.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

/// Writes to stderr as far as it goes and says that all went well.
ssize_t writeToStderr(void*, const char* bytes, size_t size) {
  for (size_t done = 0; done < size;) {
    const ssize_t count = ::write(STDERR_FILENO, bytes + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<size_t>(count);
  }
  return static_cast<ssize_t>(size);
}

/// Opens what is closed among 0, 1 and 2, so that the next file opened does not become one of them.
void fillClosed() {
  // Read only for stdout: printing to it still fails, and is noticed.
  const int modes[] = {O_RDONLY, O_RDONLY, O_WRONLY};
  for (int file = 0; file <= 2; ++file) {
    if (::fcntl(file, F_GETFD) == -1 && errno == EBADF) ::open("/dev/null", modes[file]);
  }
}

}  // namespace

void prepareStandardStreams() {
  fillClosed();
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  // A stream of the C library, so that every print to stderr, in whatever library, goes through it.
  cookie_io_functions_t only_write{};
  only_write.write = writeToStderr;
  if (FILE* deaf = ::fopencookie(nullptr, "w", only_write)) {
    std::setvbuf(deaf, nullptr, _IONBF, 0);
    stderr = deaf;
  }
}

void finishStandardOutput() {
  errno = 0;
  const bool failed_before = std::ferror(stdout) != 0;
  if (std::fflush(stdout) == 0 && !failed_before) return;
  throw OutputError(std::string("the output on stdout could not be written: ") +
                    (errno != 0 ? std::strerror(errno) : "not all of it was taken"));
}

}  // namespace ballbot
