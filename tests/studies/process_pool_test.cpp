#include "studies/process_pool.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>

#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::map<std::size_t, TaskEnd> run(std::size_t count,
                                   const std::function<std::string(std::size_t)>& task,
                                   const PoolOptions& options) {
  std::map<std::size_t, TaskEnd> ends;
  runInProcesses(count, task, options, [&](std::size_t i, const TaskEnd& end) { ends[i] = end; });
  return ends;
}

PoolOptions jobs(int n) {
  PoolOptions options;
  options.jobs = n;
  return options;
}

TEST(ProcessPool, EveryTaskRunsOnceInAProcessOfItsOwn) {
  for (const int n : {1, 3, 50}) {
    const auto ends = run(
        20, [](std::size_t i) { return std::to_string(i) + " in " + std::to_string(::getpid()); },
        jobs(n));
    ASSERT_EQ(ends.size(), 20u);
    std::map<std::string, int> processes;
    for (const auto& [i, end] : ends) {
      EXPECT_EQ(end.kind, TaskEnd::Kind::kDone);
      EXPECT_EQ(end.answer.substr(0, end.answer.find(' ')), std::to_string(i));
      ++processes[end.answer.substr(end.answer.find("in "))];
    }
    EXPECT_EQ(processes.size(), 20u) << "each task had its own process";
    EXPECT_EQ(processes.count("in " + std::to_string(::getpid())), 0u);
  }
}

TEST(ProcessPool, LongAnswersArriveWhole) {
  const auto ends = run(
      2, [](std::size_t i) { return std::string(1'000'000, i == 0 ? 'a' : 'b'); }, jobs(2));
  EXPECT_EQ(ends.at(0).answer, std::string(1'000'000, 'a'));
  EXPECT_EQ(ends.at(1).answer, std::string(1'000'000, 'b'));
}

TEST(ProcessPool, ATaskThatCrashesIsNamedAndTheOthersGoOn) {
  const auto ends = run(
      4,
      [](std::size_t i) -> std::string {
        if (i == 1) {
          std::fprintf(stderr, "about to fail\nmatrix is not positive definite\n");
          ::raise(SIGKILL);
        }
        if (i == 2) throw std::runtime_error("this and that");
        return "fine";
      },
      jobs(2));
  EXPECT_EQ(ends.at(0).answer, "fine");
  EXPECT_EQ(ends.at(3).answer, "fine");
  EXPECT_EQ(ends.at(1).kind, TaskEnd::Kind::kCrashed);
  EXPECT_EQ(ends.at(1).trouble,
            "signal 9 (Killed); its last words: matrix is not positive definite");
  EXPECT_EQ(ends.at(2).trouble, "exit code 3; its last words: this and that");
}

TEST(ProcessPool, ATaskThatHangsIsEnded) {
  PoolOptions options = jobs(2);
  options.timeout = std::chrono::milliseconds(300);
  const auto ends = run(
      3,
      [](std::size_t i) -> std::string {
        if (i == 0) ::pause();
        return "fine";
      },
      options);
  EXPECT_EQ(ends.at(0).kind, TaskEnd::Kind::kTimedOut);
  EXPECT_EQ(ends.at(0).trouble, "no end within the timeout");
  EXPECT_EQ(ends.at(2).answer, "fine");
}

TEST(ProcessPool, StopEndsEveryTask) {
  std::atomic<bool> stop{false};
  PoolOptions options = jobs(2);
  options.stop = &stop;
  int pids[2];
  ASSERT_EQ(::pipe(pids), 0);
  const auto hang = [&](std::size_t i) -> std::string {
    if (i == 2) return "";
    const pid_t pid = ::getpid();
    if (::write(pids[1], &pid, sizeof pid) != sizeof pid) return "no pipe";
    ::pause();
    return "";
  };
  std::vector<pid_t> seen(2);
  // A third task ends and tells that the others run; then comes the Ctrl-C.
  options.jobs = 3;
  EXPECT_THROW(runInProcesses(3, hang, options,
                              [&](std::size_t, const TaskEnd&) {
                                for (pid_t& pid : seen)
                                  ASSERT_EQ(::read(pids[0], &pid, sizeof pid),
                                            static_cast<ssize_t>(sizeof pid));
                                stop = true;
                              }),
               InterruptedError);
  for (const pid_t pid : seen)
    EXPECT_EQ(::kill(pid, 0), -1) << "process " << pid << " is still there";
  ::close(pids[0]);
  ::close(pids[1]);
}

}  // namespace
}  // namespace ballbot
