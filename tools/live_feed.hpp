#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "cosim/lcm_bus.hpp"
#include "cosim/lcm_transport.hpp"
#include "experiment/live_scene.hpp"
#include "tools/http_server.hpp"

namespace ballbot {

/// Listens to the replies of a plant on an LCM network, as they go to its controller, and makes a
/// frame of the newest true state 25 times a second. It only listens: no run can tell it is there.
class LiveFeed final : public EventSource {
 public:
  /// @throw InputError if LCM cannot use the address.
  LiveFeed(const LcmAddress& address, LiveScene scene);
  ~LiveFeed() override;

  bool next(std::uint64_t& seen, std::string& out, std::chrono::milliseconds timeout) override;

 private:
  void listen();

  LcmBus bus_;
  LiveScene scene_;
  std::atomic<bool> quit_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string newest_;
  std::uint64_t number_ = 0;
  std::thread listener_;
};

}  // namespace ballbot
