#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hil/can_bus.hpp"
#include "hil/latency/answer_probe.hpp"
#include "hil/recorder/flight_recorder.hpp"

namespace ballbot {

/// A bus that copies every frame that passes into a recorder, and is the bus within otherwise.
class RecordedBus final : public CanBus {
 public:
  /// All must outlive this. @param probe  is told of every frame, too; may be null
  RecordedBus(CanBus& inner, int number, FlightRecorder& recorder, AnswerProbe* probe = nullptr)
      : inner_(inner), number_(number), recorder_(recorder), probe_(probe) {}

  bool send(const CanFrame& frame) noexcept override {
    const bool sent = inner_.send(frame);
    const std::int64_t now = recorder_.onFrame(number_, frame, true, !sent);
    if (probe_ != nullptr && sent) probe_->onFrame(now, number_, frame, true);
    return sent;
  }
  bool receive(CanFrame& out) noexcept override {
    if (!inner_.receive(out)) return false;
    const std::int64_t now = recorder_.onFrame(number_, out, false, false);
    if (probe_ != nullptr) probe_->onFrame(now, number_, out, false);
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
  AnswerProbe* probe_;
};

/// All buses of a bench, recorded.
class RecordedBuses {
 public:
  /// The buses, the recorder and the probe must outlive this.
  RecordedBuses(const std::vector<CanBus*>& inner, FlightRecorder& recorder,
                AnswerProbe* probe = nullptr) {
    for (CanBus* bus : inner) {
      const int number = static_cast<int>(owned_.size());
      owned_.push_back(std::make_unique<RecordedBus>(*bus, number, recorder, probe));
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
