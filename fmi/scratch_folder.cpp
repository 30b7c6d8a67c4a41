#include "fmi/scratch_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

std::string makeFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  std::string path = (parent / "ballbot_fmu_XXXXXX").string();
  if (error || !::mkdtemp(path.data())) {
    throw OutputError(
        fmt::format("{}: cannot be created: {}. Is the temporary folder (TMPDIR) there?", path,
                    error ? error.message() : std::strerror(errno)));
  }
  return path;
}

/// The second process: waits until the first has closed its end of `life`, then tidies up.
[[noreturn]] void removeAfter(int life, int kept_open, const std::string& folder) {
  ::setsid();  // no signal to a terminal's or an FMU's group arrives here
  for (const int s : {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGPIPE}) ::signal(s, SIG_IGN);
  ::prctl(PR_SET_NAME, "fmu-tidy");
  for (const int standard : {0, 1, 2}) ::close(standard);  // nobody's output waits for this one
  for (int fd = 3; fd < 1024; ++fd) {
    if (fd != life && fd != kept_open) ::close(fd);
  }
  char byte = 0;
  while (::read(life, &byte, 1) < 0 && errno == EINTR) {
  }
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  ::_exit(0);
}

}  // namespace

ScratchFolder::ScratchFolder(int kept_open) : path_(makeFolder()) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) == 0) {
    remover_ = ::fork();
    if (remover_ == 0) {
      ::close(ends[1]);
      removeAfter(ends[0], kept_open, path_);
    }
    ::close(ends[0]);
    life_ = ends[1];
  }
  if (remover_ < 0) {
    const std::string why = std::strerror(errno);
    if (life_ >= 0) ::close(life_);
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    throw OutputError(fmt::format("{}: nothing can watch over it: {}", path_, why));
  }
}

ScratchFolder::~ScratchFolder() {
  ::close(life_);
  while (::waitpid(remover_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace ballbot
