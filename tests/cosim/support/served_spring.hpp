#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "cosim/memory_transport.hpp"
#include "cosim/remote_participant.hpp"
#include "cosim/serve.hpp"
#include "tests/cosim/support/spring_participant.hpp"

namespace ballbot::testing_support {

constexpr SimDuration kStepLength{1'000'000};

inline RemoteOptions remoteOptions() {
  RemoteOptions options;
  options.name = "plant";
  options.config_digest = 1;
  options.patience = std::chrono::milliseconds{300};
  options.first_patience = std::chrono::milliseconds{300};
  return options;
}

/// A spring served in a thread of its own.
class ServedSpring {
 public:
  explicit ServedSpring(ServeOptions options = {}) {
    auto [here, there] = makeMemoryLink();
    master_end = std::move(here);
    far_end_ = std::move(there);
    if (options.config_digest == 0) options.config_digest = 1;
    options.stop = &stop;
    thread_ = std::thread([this, options] {
      try {
        report = serve(spring, *far_end_, options);
      } catch (const Error& error) {
        lost = error.what();
      }
    });
  }
  ~ServedSpring() { join(); }
  void join() {
    if (!thread_.joinable()) return;
    thread_.join();
  }

  SpringParticipant spring;
  std::unique_ptr<Transport> master_end;
  std::atomic<bool> stop{false};
  ServeReport report;  // these two after join()
  std::string lost;

 private:
  std::unique_ptr<Transport> far_end_;
  std::thread thread_;
};

}  // namespace ballbot::testing_support
