#include "hil/slcan_bus.hpp"

#include <cstring>
#include <thread>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

using std::chrono::milliseconds;
using WallClock = std::chrono::steady_clock;

constexpr int kRates[] = {10, 20, 50, 100, 125, 250, 500, 800, 1000};  // S0 to S8
constexpr milliseconds kReplyTimeout{1000};
constexpr milliseconds kSettling{20};
// A channel that a host left open goes on bringing frames; for so long they are passed over.
constexpr milliseconds kDraining{200};

/// The digit of the S command for a bit rate.
char rateDigit(const std::string& device, int bitrate_kbps) {
  for (std::size_t i = 0; i < std::size(kRates); ++i) {
    if (kRates[i] == bitrate_kbps) return static_cast<char>('0' + i);
  }
  throw InputError(
      fmt::format("{}: {} kbit/s is no rate of slcan adapters; take 10, 20, 50, 100, 125, 250, "
                  "500, 800 or 1000",
                  device, bitrate_kbps));
}

/// The digit of the Y command: Mbit/s.
char dataRateDigit(const std::string& device, const CanBusSettings& settings) {
  const int mbps = settings.data_bitrate_kbps / 1000;
  if (settings.data_bitrate_kbps % 1000 == 0 && mbps >= 1 && mbps <= 8) {
    return static_cast<char>('0' + mbps);
  }
  throw InputError(
      fmt::format("{}: CAN FD data at {} kbit/s; slcan adapters have whole Mbit/s, 1 to 8", device,
                  settings.data_bitrate_kbps));
}

}  // namespace

SlcanBus::SlcanBus(const std::string& device, const CanBusSettings& settings)
    : settings_(settings), rate_(rateDigit(device, settings.bitrate_kbps)), port_(device) {
  // Ends whatever an earlier host left half written, and drops what the adapter says to that.
  port_.write("\r\r", 2);
  const auto settled = WallClock::now() + kDraining;
  while (WallClock::now() < settled && port_.waitReadable(kSettling) && up_) {
    fill();
    input_begin_ = input_end_ = 0;
  }
  parser_ = SlcanParser{};
  // An adapter whose channel is closed already refuses C; one that was left open sends frames.
  command("C", true);
  command(std::string("S") + rate_, false);
  if (settings.flexible()) command(std::string("Y") + dataRateDigit(device, settings), false);
  command("O", false);
}

SlcanBus::~SlcanBus() {
  flush();
  port_.write("C\r", 2);
}

// Sends one command and waits for its answer; frames that come in between are from before.
void SlcanBus::command(const std::string& line, bool may_be_refused) {
  const std::string text = line + "\r";
  if (port_.write(text.data(), text.size()) != static_cast<int>(text.size())) {
    throw InputError(
        fmt::format("{}: cannot write to the adapter. Is it plugged in?", port_.path()));
  }
  if (!settings_.acknowledges) {  // time to act on it, whatever it says
    std::this_thread::sleep_for(kSettling);
    while (next() != SlcanParser::Item::kNone) continue;
    return;
  }
  const auto until = WallClock::now() + kReplyTimeout;
  while (WallClock::now() < until && up_) {
    const SlcanParser::Item item = next();
    if (item == SlcanParser::Item::kDone) return;
    if (item == SlcanParser::Item::kRefused) {
      if (may_be_refused) return;
      throw InputError(fmt::format("{}: the adapter refuses '{}'{}", port_.path(), line,
                                   line[0] == 'Y'
                                       ? ", so it has no CAN FD at that data bit rate; "
                                         "2 and 5 Mbit/s are common. SocketCAN has CAN FD, too"
                                       : ""));
    }
    if (item == SlcanParser::Item::kNone) port_.waitReadable(milliseconds(50));
  }
  throw InputError(fmt::format(
      "{}: no answer to '{}' within {} ms. Does the adapter speak slcan (LAWICEL)? If it "
      "does but acknowledges nothing, say so: `acknowledges: false` for this bus",
      port_.path(), line, kReplyTimeout.count()));
}

bool SlcanBus::send(const CanFrame& frame) noexcept {
  std::array<char, kSlcanLineMax> line;
  const std::size_t size = encodeSlcan(frame, line);
  if (size == 0 || !up_ || output_size_ + size > output_.size()) {
    ++counters_.refused;
    return false;
  }
  std::memcpy(output_.data() + output_size_, line.data(), size);
  output_size_ += size;
  flush();
  ++counters_.sent;
  return true;
}

void SlcanBus::flush() noexcept {
  if (output_size_ == 0) return;
  const int n = port_.write(output_.data(), output_size_);
  if (n < 0) {
    up_ = false;
    return;
  }
  output_size_ -= static_cast<std::size_t>(n);
  std::memmove(output_.data(), output_.data() + n, output_size_);
}

bool SlcanBus::receive(CanFrame& out) noexcept {
  flush();
  for (;;) {
    switch (next()) {
      case SlcanParser::Item::kNone:
        return false;
      case SlcanParser::Item::kFrame:
        out = parser_.frame();
        ++counters_.received;
        return true;
      case SlcanParser::Item::kRefused:
        ++counters_.errors;
        break;
      case SlcanParser::Item::kMalformed:
        ++counters_.malformed;
        break;
      default:
        break;
    }
  }
}

bool SlcanBus::waitReadable(std::chrono::nanoseconds timeout) noexcept {
  flush();
  return input_begin_ < input_end_ || port_.waitReadable(timeout);
}

SlcanParser::Item SlcanBus::next() noexcept {
  for (;;) {
    if (input_begin_ == input_end_) fill();
    if (input_begin_ == input_end_) return SlcanParser::Item::kNone;
    const SlcanParser::Item item = parser_.take(input_[input_begin_++]);
    if (item != SlcanParser::Item::kNone) return item;
  }
}

void SlcanBus::fill() noexcept {
  input_begin_ = input_end_ = 0;
  const int n = port_.read(input_.data(), input_.size());
  if (n < 0) up_ = false;
  if (n > 0) input_end_ = static_cast<std::size_t>(n);
}

std::string SlcanBus::describe() const {
  const std::string fd =
      settings_.flexible() ? fmt::format(", CAN FD at {} kbit/s", settings_.data_bitrate_kbps) : "";
  return fmt::format("slcan on {}, {} kbit/s{}{}", port_.path(), settings_.bitrate_kbps, fd,
                     settings_.acknowledges ? "" : ", an adapter that acknowledges nothing");
}

}  // namespace ballbot
