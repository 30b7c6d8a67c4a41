#include "studies/process_pool.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

using Clock = std::chrono::steady_clock;

// How late a Ctrl-C that came between two system calls may be noticed.
constexpr int kPollPeriod_ms = 200;
constexpr int kTaskThrew = 3;

bool writeAll(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

/// The child's part: never returns.
[[noreturn]] void work(const std::function<std::string()>& task, int answer, int words,
                       pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kTaskThrew);  // the parent died before prctl took hold
  ::setpgid(0, 0);  // Ctrl-C is for the parent, which decides about its tasks
  ::signal(SIGINT, SIG_DFL);
  ::signal(SIGTERM, SIG_DFL);
  const int null = ::open("/dev/null", O_RDWR);
  ::dup2(null, 0);
  ::dup2(null, 1);
  if (words >= 0) ::dup2(words, 2);
  try {
    ::_exit(writeAll(answer, task()) ? 0 : kTaskThrew);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    ::_exit(kTaskThrew);
  }
}

/// One running task.
class Child {
 public:
  Child(std::size_t index, const std::function<std::string()>& task, Clock::time_point deadline)
      : index_(index), deadline_(deadline), words_(::memfd_create("stderr", MFD_CLOEXEC)) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw OutputError(fmt::format("no pipe to a case: {}", std::strerror(errno)));
    std::fflush(nullptr);
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ == 0) work(task, ends[1], words_, parent);
    ::close(ends[1]);
    answer_file_ = ends[0];
    if (pid_ < 0) throw OutputError(fmt::format("no process for a case: {}", std::strerror(errno)));
  }
  Child(Child&& other) noexcept { swap(other); }
  Child& operator=(Child&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Child() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
      }
    }
    if (answer_file_ >= 0) ::close(answer_file_);
    if (words_ >= 0) ::close(words_);
  }

  std::size_t index() const { return index_; }
  int file() const { return answer_file_; }
  Clock::time_point deadline() const { return deadline_; }

  /// Takes what there is to read. True once there will be no more.
  bool read() {
    char buffer[65536];
    const ssize_t n = ::read(answer_file_, buffer, sizeof buffer);
    if (n < 0) return errno != EINTR && errno != EAGAIN;
    answer_.append(buffer, static_cast<std::size_t>(n));
    return n == 0;
  }

  TaskEnd end(bool timed_out) {
    if (timed_out) ::kill(pid_, SIGKILL);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !timed_out)
      return {TaskEnd::Kind::kDone, answer_, ""};
    std::string how = "no end within the timeout";
    if (!timed_out) {
      how = WIFSIGNALED(status)
                ? fmt::format("signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))
                : fmt::format("exit code {}", WEXITSTATUS(status));
    }
    const std::string words = lastWords();
    return {timed_out ? TaskEnd::Kind::kTimedOut : TaskEnd::Kind::kCrashed, "",
            words.empty() ? how : how + "; its last words: " + words};
  }

 private:
  std::string lastWords() const {
    char buffer[2048];
    const off_t size = ::lseek(words_, 0, SEEK_END);
    const ssize_t n = ::pread(words_, buffer, sizeof buffer,
                              std::max<off_t>(0, size - static_cast<off_t>(sizeof buffer)));
    std::string text(buffer, n > 0 ? static_cast<std::size_t>(n) : 0);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text.substr(text.rfind('\n') + 1);
  }
  void swap(Child& other) {
    std::swap(index_, other.index_);
    std::swap(deadline_, other.deadline_);
    std::swap(words_, other.words_);
    std::swap(pid_, other.pid_);
    std::swap(answer_file_, other.answer_file_);
    std::swap(answer_, other.answer_);
  }

  std::size_t index_ = 0;
  Clock::time_point deadline_{};
  int words_ = -1;
  pid_t pid_ = -1;
  int answer_file_ = -1;
  std::string answer_;
};

}  // namespace

int processorCount() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

void runInProcesses(std::size_t count, const std::function<std::string(std::size_t)>& task,
                    const PoolOptions& options,
                    const std::function<void(std::size_t, const TaskEnd&)>& ended) {
  std::vector<Child> running;
  for (std::size_t next = 0; next < count || !running.empty();) {
    if (options.stop && *options.stop) throw InterruptedError("interrupted");
    while (next < count && running.size() < static_cast<std::size_t>(std::max(1, options.jobs))) {
      running.emplace_back(
          next, [&task, next] { return task(next); }, Clock::now() + options.timeout);
      ++next;
    }
    int wait_ms = kPollPeriod_ms;
    std::vector<pollfd> files;
    for (const Child& child : running) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(child.deadline() - Clock::now())
              .count();
      wait_ms = static_cast<int>(std::clamp<long>(left + 1, 0, wait_ms));
      files.push_back({child.file(), POLLIN, 0});
    }
    ::poll(files.data(), files.size(), wait_ms);
    for (std::size_t i = running.size(); i-- > 0;) {
      const bool complete = files[i].revents != 0 && running[i].read();
      const bool timed_out = !complete && Clock::now() > running[i].deadline();
      if (!complete && !timed_out) continue;
      Child child = std::move(running[i]);
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      ended(child.index(), child.end(timed_out));
    }
  }
}

}  // namespace ballbot
