#pragma once

#include <atomic>
#include <chrono>
#include <vector>

#include "hil/bench_master.hpp"
#include "hil/can_bus.hpp"
#include "hil/frame_bits.hpp"

namespace ballbot {

/// Carries frames between a BenchMaster and its buses.
class BenchIo {
 public:
  /// Both must outlive this; one bus per bus of the configuration, in its order.
  BenchIo(BenchMaster& master, std::vector<CanBus*> buses);

  /// Sends what is in the master's outboxes, bus 0 first.
  void send() noexcept;
  /// Hands over what arrives, and sends what the master answers, until it awaits nothing or
  /// `until`; not much longer once `stop` is set. False if something was still awaited then.
  bool collect(std::chrono::steady_clock::time_point until,
               const std::atomic<bool>* stop = nullptr) noexcept;
  bool allUp() const noexcept;
  /// Bits of all frames that went over a bus, either way: nominal and with the most stuffing.
  const FrameBits& load(int bus) const noexcept { return load_[static_cast<std::size_t>(bus)]; }

 private:
  bool anyUp() const noexcept;
  bool wait(std::chrono::nanoseconds timeout) noexcept;
  void count(std::size_t bus, const CanFrame& frame) noexcept;

  BenchMaster& master_;
  std::vector<CanBus*> buses_;
  std::vector<FrameBits> load_;
};

}  // namespace ballbot
