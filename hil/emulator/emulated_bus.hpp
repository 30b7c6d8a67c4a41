#pragma once

#include <string>

#include "hil/can_bus.hpp"
#include "hil/emulator/emulated_bench.hpp"

namespace ballbot {

/// A master's end of an emulated bench in the same process: what is sent is acted on at once. For
/// tests and rehearsals; it may allocate.
class EmulatedBus : public CanBus {
 public:
  /// `bench` must outlive this.
  EmulatedBus(EmulatedBench& bench, int number) : bench_(bench), number_(number) {}

  bool send(const CanFrame& frame) noexcept override {
    if (!isValid(frame) || !up_) {
      ++counters_.refused;
      return false;
    }
    bench_.onFrame(number_, frame);
    ++counters_.sent;
    return true;
  }
  bool receive(CanFrame& out) noexcept override {
    auto& queue = bench_.outbox(number_);
    if (queue.empty() || !up_) return false;
    out = queue.front();
    queue.pop_front();
    ++counters_.received;
    return true;
  }
  bool waitReadable(std::chrono::nanoseconds) noexcept override {
    return up_ && !bench_.outbox(number_).empty();
  }
  int descriptor() const noexcept override { return -1; }
  bool isUp() const noexcept override { return up_; }
  const CanCounters& counters() const noexcept override { return counters_; }
  std::string describe() const override { return "emulated bus " + std::to_string(number_); }
  /// As if the adapter had been pulled out.
  void pull() { up_ = false; }

 private:
  EmulatedBench& bench_;
  int number_;
  bool up_ = true;
  CanCounters counters_;
};

}  // namespace ballbot
