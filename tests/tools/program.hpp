#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace ballbot {

/// What a finished program left behind.
struct Finished {
  int exit_code = -1;  ///< or 128 + signal
  std::string out, err;
};

/// The ballbot executable, run as a person would.
class Program {
 public:
  /// @param file_size_limit_bytes  writes beyond it fail, as on a full disk; negative: no limit
  explicit Program(const std::vector<std::string>& arguments, long file_size_limit_bytes = -1);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const;
  /// Waits for the end; fails the test and kills it after `timeout_s`.
  Finished finish(int timeout_s = 300);
  /// What it has said on stderr so far.
  std::string errSoFar() const;
  /// Process ids of its children.
  std::vector<pid_t> children() const;

 private:
  std::string out_path_, err_path_;
  pid_t pid_ = -1;
};

Finished runBallbot(const std::vector<std::string>& arguments, int timeout_s = 300);

/// A folder that goes when the object goes.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

std::string scenarioPath(
    const std::string& name);  ///< "balance" -> .../configs/scenarios/balance.yaml
std::string readFile(const std::string& path);

}  // namespace ballbot
