#include "hil/sdo_exchange.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "hil/canopen_codec.hpp"

namespace ballbot {
namespace {

using WallClock = std::chrono::steady_clock;

}  // namespace

std::optional<std::int64_t> SdoExchange::number(std::uint16_t index, std::uint8_t sub) {
  if (!upload(index, sub)) return std::nullopt;
  return static_cast<std::int64_t>(
      getLittleEndian(client_.data(), std::min<std::size_t>(client_.size(), 8)));
}

std::optional<std::string> SdoExchange::text(std::uint16_t index) {
  if (!upload(index, 0)) return std::nullopt;
  return std::string(reinterpret_cast<const char*>(client_.data()), client_.size());
}

std::string SdoExchange::whyNot(const char* what) const {
  const std::string object = toText(client_.object());
  if (client_.status() != SdoClient::Status::kAborted) {
    return fmt::format("{} {}: no answer within {} ms", object, what, patience_.count());
  }
  return fmt::format("{} {}: refused, {:08X} ({})", object, what, client_.abortCode(),
                     sdoAbortText(client_.abortCode()));
}

bool SdoExchange::write(std::uint16_t index, std::uint8_t sub, std::int64_t value,
                        std::size_t size) {
  std::array<std::uint8_t, 8> bytes{};
  putLittleEndian(bytes.data(), static_cast<std::uint64_t>(value), size);
  client_.download({index, sub}, bytes.data(), size, queue_);
  return carryOut();
}

bool SdoExchange::upload(std::uint16_t index, std::uint8_t sub) {
  client_.upload({index, sub}, queue_);
  return carryOut();
}

bool SdoExchange::carryOut() {
  auto until = WallClock::now() + patience_;
  CanFrame frame;
  while (client_.status() == SdoClient::Status::kBusy) {
    for (const CanFrame& out : queue_) bus_.send(out);
    queue_.clear();
    const auto left = until - WallClock::now();
    if (left <= WallClock::duration::zero()) break;
    bus_.waitReadable(left);
    bool any = false;
    while (bus_.receive(frame)) {
      any = true;
      if (client_.onFrame(frame, queue_)) until = WallClock::now() + patience_;
    }
    if (!any && bus_.descriptor() < 0) break;  // a bus in this process has nothing more to say
  }
  for (const CanFrame& out : queue_) bus_.send(out);
  queue_.clear();
  return client_.status() == SdoClient::Status::kDone;
}

}  // namespace ballbot
