#include "tests/tools/program.hpp"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ballbot {

namespace fs = std::filesystem;

namespace {

std::string uniquePath(const std::string& stem) {
  static std::atomic<int> count{0};
  return (fs::temp_directory_path() /
          (stem + "_" + std::to_string(::getpid()) + "_" + std::to_string(count++)))
      .string();
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, long file_size_limit_bytes)
    : out_path_(uniquePath("ballbot_out")), err_path_(uniquePath("ballbot_err")) {
  std::string program = std::string(BALLBOT_BIN_DIR) + "/ballbot";
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& a : copies) argv.push_back(a.data());
  argv.push_back(nullptr);
  pid_ = ::fork();
  if (pid_ == 0) {
    ::dup2(::open("/dev/null", O_RDONLY), 0);
    ::dup2(::open(out_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
    ::dup2(::open(err_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
    if (file_size_limit_bytes >= 0) {
      const auto bytes = static_cast<rlim_t>(file_size_limit_bytes);
      const rlimit limit{bytes, bytes};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      ::signal(SIGXFSZ, SIG_IGN);  // write() then fails as on a full disk
    }
    ::execv(program.c_str(), argv.data());
    ::_exit(127);
  }
}

Program::~Program() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  fs::remove(out_path_);
  fs::remove(err_path_);
}

void Program::signal(int number) const { ::kill(pid_, number); }

Finished Program::finish(int timeout_s) {
  using Clock = std::chrono::steady_clock;
  const auto give_up = Clock::now() + std::chrono::seconds(timeout_s);
  int status = 0;
  while (::waitpid(pid_, &status, WNOHANG) == 0) {
    if (Clock::now() > give_up) {
      ADD_FAILURE() << "ballbot did not end within " << timeout_s << " s";
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, &status, 0);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  pid_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), readFile(out_path_),
          readFile(err_path_)};
}

std::string Program::errSoFar() const { return readFile(err_path_); }

std::vector<pid_t> Program::children() const {
  const std::string pid = std::to_string(pid_);
  std::vector<pid_t> out;
  std::ifstream in("/proc/" + pid + "/task/" + pid + "/children");
  for (pid_t child; in >> child;) out.push_back(child);
  return out;
}

Finished runBallbot(const std::vector<std::string>& arguments, int timeout_s) {
  return Program(arguments).finish(timeout_s);
}

TemporaryFolder::TemporaryFolder() : path_(uniquePath("ballbot_test")) {
  fs::create_directories(path_);
}
TemporaryFolder::~TemporaryFolder() { fs::remove_all(path_); }

std::string scenarioPath(const std::string& name) {
  return std::string(BALLBOT_SOURCE_DIR) + "/configs/scenarios/" + name + ".yaml";
}

std::string readFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace ballbot
