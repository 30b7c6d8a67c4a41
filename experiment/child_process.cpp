#include "experiment/child_process.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

int exitCodeOf(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ChildProcess::ChildProcess(std::string name, const std::vector<std::string>& arguments,
                           const std::string& stderr_path, int core)
    : name_(std::move(name)), stderr_path_(stderr_path) {
  std::vector<char*> argv;
  std::string program = "ballbot";
  argv.push_back(program.data());
  std::vector<std::string> copies = arguments;
  for (std::string& a : copies) argv.push_back(a.data());
  argv.push_back(nullptr);

  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ < 0) {
    throw LostParticipantError(name_,
                               fmt::format("{}: cannot start: {}", name_, std::strerror(errno)));
  }
  if (pid_ == 0) {
    // Only async-signal-safe calls from here to exec.
    // SIGKILL, since one that is stopped (Ctrl-Z, a debugger) would never come to hear another.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(3);  // the parent died before prctl took hold
    // Ctrl-C reaches the whole terminal group; the parent tells its children what to do instead.
    ::setpgid(0, 0);
    const int null = ::open("/dev/null", O_RDWR);
    const int err = ::open(stderr_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(null, 0);
    ::dup2(null, 1);
    ::dup2(err >= 0 ? err : null, 2);
    if (core >= 0) {
      cpu_set_t set;
      CPU_ZERO(&set);
      CPU_SET(core, &set);
      ::sched_setaffinity(0, sizeof set, &set);
    }
    ::execv("/proc/self/exe", argv.data());
    ::_exit(127);
  }
}

ChildProcess::~ChildProcess() {
  if (running()) finish(0);
}

bool ChildProcess::running() {
  if (pid_ < 0) return false;
  const pid_t done = ::waitpid(pid_, &status_, WNOHANG);
  if (done == 0) return true;
  pid_ = -1;
  return false;
}

int ChildProcess::finish(int timeout_ms) {
  const auto waitFor = [&](int ms) {
    for (int waited = 0; running(); waited += 2) {
      if (waited >= ms) return false;
      ::usleep(2000);
    }
    return true;
  };
  if (waitFor(timeout_ms)) return exitCodeOf(status_);
  ::kill(pid_, SIGTERM);
  if (!waitFor(1000)) {
    ::kill(pid_, SIGKILL);
    waitFor(5000);
  }
  return exitCodeOf(status_);
}

void ChildProcess::kill() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  while (running()) ::usleep(1000);
}

int ChildProcess::exitCode() const { return exitCodeOf(status_); }

std::string ChildProcess::lastLine() const {
  std::string last, line;
  std::ifstream in(stderr_path_);
  while (std::getline(in, line)) {
    if (!line.empty()) last = line;
  }
  const std::string name = "ballbot: ";
  return last.rfind(name, 0) == 0 ? last.substr(name.size()) : last;
}

std::string ChildProcess::lastWords() {
  const std::string last = lastLine();
  std::string how = "is still running";
  if (!running()) {
    how = WIFEXITED(status_) ? fmt::format("ended with exit code {}", WEXITSTATUS(status_))
                             : fmt::format("was ended by signal {} ({})", WTERMSIG(status_),
                                           ::strsignal(WTERMSIG(status_)));
  }
  return last.empty() ? how : fmt::format("{}; its last words: {}", how, last);
}

bool pinToCore(int core) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(core, &set);
  return ::sched_setaffinity(0, sizeof set, &set) == 0;
}

int preferredCore() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return 0;
  int last = 0;
  for (int i = 0; i < CPU_SETSIZE; ++i) {
    if (CPU_ISSET(i, &set)) last = i;
  }
  return last;
}

}  // namespace ballbot
