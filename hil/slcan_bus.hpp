#pragma once

#include <array>
#include <memory>
#include <string>

#include "hil/can_bus.hpp"
#include "hil/serial_port.hpp"
#include "hil/slcan_codec.hpp"

namespace ballbot {

/// A CAN bus behind a serial adapter that speaks the LAWICEL protocol; CAN FD where it also speaks
/// what CANable adapters have added to it.
class SlcanBus final : public CanBus {
 public:
  /// Opens the device, closes whatever channel was open, sets the bit rate and opens the channel.
  /// @param settings  bit rate 10, 20, 50, 100, 125, 250, 500, 800 or 1000 kbit/s. Of an adapter
  /// that
  ///                  acknowledges nothing no answer is expected; whether it is one then shows only
  ///                  by the nodes behind it
  /// @throw InputError as SerialPort, for another bit rate, or if the adapter does not answer.
  SlcanBus(const std::string& device, const CanBusSettings& settings);
  ~SlcanBus() override;

  bool send(const CanFrame& frame) noexcept override;
  bool receive(CanFrame& out) noexcept override;
  bool waitReadable(std::chrono::nanoseconds timeout) noexcept override;
  int descriptor() const noexcept override { return port_.descriptor(); }
  bool isUp() const noexcept override { return up_; }
  const CanCounters& counters() const noexcept override { return counters_; }
  std::string describe() const override;

 private:
  static constexpr std::size_t kBufferBytes = 8192;

  SlcanParser::Item next() noexcept;
  void fill() noexcept;
  void flush() noexcept;
  void command(const std::string& line, bool may_be_refused);

  CanBusSettings settings_;
  char rate_;  ///< digit of the S command
  SerialPort port_;
  SlcanParser parser_;
  bool up_ = true;
  CanCounters counters_;
  std::array<char, kBufferBytes> input_{}, output_{};
  std::size_t input_begin_ = 0, input_end_ = 0;
  std::size_t output_size_ = 0;
};

}  // namespace ballbot
