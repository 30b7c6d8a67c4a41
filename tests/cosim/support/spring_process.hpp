#pragma once

#include <sys/types.h>

#include "cosim/lcm_transport.hpp"

namespace ballbot::testing_support {

/// A spring in a process of its own, serving on an LCM address (spring_process_main.cpp).
class SpringProcess {
 public:
  /// Returns when it listens.
  explicit SpringProcess(const LcmAddress& address);
  ~SpringProcess();
  SpringProcess(const SpringProcess&) = delete;
  SpringProcess& operator=(const SpringProcess&) = delete;

  /// Ends it without warning.
  void kill();
  /// Waits for its end and returns its exit code.
  int wait();

 private:
  pid_t pid_ = -1;
};

}  // namespace ballbot::testing_support
