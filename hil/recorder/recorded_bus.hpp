#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hil/can_bus.hpp"
#include "hil/recorder/flight_recorder.hpp"

namespace ballbot {

/// A bus that copies every frame that passes into a recorder, and is the bus within otherwise.
class RecordedBus final : public CanBus {
 public:
  /// Both must outlive this.
  RecordedBus(CanBus& inner, int number, FlightRecorder& recorder)
      : inner_(inner), number_(number), recorder_(recorder) {}

  bool send(const CanFrame& frame) noexcept override {
    const bool sent = inner_.send(frame);
    recorder_.onFrame(number_, frame, true, !sent);
    return sent;
  }
  bool receive(CanFrame& out) noexcept override {
    if (!inner_.receive(out)) return false;
    recorder_.onFrame(number_, out, false, false);
    return true;
  }
  bool waitReadable(std::chrono::nanoseconds timeout) noexcept override {
    return inner_.waitReadable(timeout);
  }
  int descriptor() const noexcept override { return inner_.descriptor(); }
  bool isUp() const noexcept override { return inner_.isUp(); }
  const CanCounters& counters() const noexcept override { return inner_.counters(); }
  std::string describe() const override { return inner_.describe(); }

 private:
  CanBus& inner_;
  int number_;
  FlightRecorder& recorder_;
};

/// All buses of a bench, recorded.
class RecordedBuses {
 public:
  /// The buses and the recorder must outlive this.
  RecordedBuses(const std::vector<CanBus*>& inner, FlightRecorder& recorder) {
    for (CanBus* bus : inner) {
      const int number = static_cast<int>(owned_.size());
      owned_.push_back(std::make_unique<RecordedBus>(*bus, number, recorder));
    }
  }
  std::vector<CanBus*> ends() const {
    std::vector<CanBus*> out;
    for (const auto& bus : owned_) out.push_back(bus.get());
    return out;
  }

 private:
  std::vector<std::unique_ptr<RecordedBus>> owned_;
};

}  // namespace ballbot
