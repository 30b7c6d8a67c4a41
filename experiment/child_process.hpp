#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace ballbot {

/// Another process of this program, e.g. the plant. It is told to die when its parent dies, so a
/// killed run leaves no orphan; the destructor ends it if it still lives.
class ChildProcess {
 public:
  /// Starts this executable with `arguments`. What the child says on stderr goes to
  /// `stderr_path`; it has no stdin and its stdout is discarded.
  /// @param core  processor to run on, or -1 for any.
  /// @throw Error if the process cannot be started.
  ChildProcess(std::string name, const std::vector<std::string>& arguments,
               const std::string& stderr_path, int core = -1);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  const std::string& name() const { return name_; }
  pid_t pid() const { return pid_; }
  bool running();

  /// Waits up to `timeout_ms`; then SIGTERM and, a second later, SIGKILL.
  /// @return the exit code, or 128 + signal.
  int finish(int timeout_ms);
  void kill();

  /// Once it has ended: its exit code, or 128 + signal.
  int exitCode() const;
  /// What it said last on stderr, without the name of the program; "" if nothing.
  std::string lastLine() const;
  /// How it ended, in words ("exit code 2", "signal 11 (Segmentation fault)"), and what it said
  /// last on stderr.
  std::string lastWords();

 private:
  std::string name_, stderr_path_;
  pid_t pid_ = -1;
  int status_ = 0;
};

/// Keeps the calling thread, and threads it starts, on one processor. False where not permitted.
bool pinToCore(int core);
/// The processor a lockstep run should sit on: the last one this process may use.
int preferredCore();

}  // namespace ballbot
