#include "tests/cosim/support/spring_process.hpp"

#include <csignal>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ballbot::testing_support {

SpringProcess::SpringProcess(const LcmAddress& address) {
  int ready[2];
  EXPECT_EQ(::pipe(ready), 0);
  pid_ = ::fork();
  if (pid_ == 0) {
    ::dup2(ready[1], STDOUT_FILENO);
    ::execl(BALLBOT_SPRING_PROCESS, BALLBOT_SPRING_PROCESS, address.url.c_str(),
            address.channel.c_str(), nullptr);
    ::_exit(127);
  }
  ::close(ready[1]);
  char byte = 0;
  EXPECT_EQ(::read(ready[0], &byte, 1), 1) << BALLBOT_SPRING_PROCESS << " did not start";
  ::close(ready[0]);
}

SpringProcess::~SpringProcess() {
  if (pid_ > 0) kill();
}

void SpringProcess::kill() {
  ::kill(pid_, SIGKILL);
  wait();
}

int SpringProcess::wait() {
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace ballbot::testing_support
