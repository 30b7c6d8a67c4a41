#include "hil/emulator/serve_drives.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include <poll.h>

#include "hil/emulator/pty_bus.hpp"

namespace ballbot {
namespace {

using WallClock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kTick = milliseconds(1);  // of time without frames
// Stepped: after so long without a frame time passes by the wall, where SYNC is not the clock.
constexpr nanoseconds kSilence = milliseconds(100);

void sendAll(EmulatedBench& bench, const std::vector<std::unique_ptr<CanBus>>& buses) {
  for (std::size_t b = 0; b < buses.size(); ++b) {
    auto& queue = bench.outbox(static_cast<int>(b));
    for (const CanFrame& frame : queue) buses[b]->send(frame);
    queue.clear();
  }
}

void waitForAny(const std::vector<std::unique_ptr<CanBus>>& buses, nanoseconds timeout) {
  std::array<pollfd, 2> entries{};
  for (std::size_t b = 0; b < buses.size(); ++b) {
    if (buses[b]->waitReadable(nanoseconds::zero())) return;
    entries[b] = {buses[b]->descriptor(), POLLIN, 0};
  }
  const timespec time{timeout.count() / 1'000'000'000, timeout.count() % 1'000'000'000};
  ::ppoll(entries.data(), static_cast<nfds_t>(buses.size()), &time, nullptr);
}

}  // namespace

std::vector<std::unique_ptr<CanBus>> openEmulatedBuses(
    const EmulatorConfig& config,
    const std::function<std::unique_ptr<CanBus>(const std::string&)>& open_socketcan) {
  std::vector<std::unique_ptr<CanBus>> buses;
  for (const std::string& link : config.links) {
    if (link.rfind("socketcan:", 0) == 0) {
      buses.push_back(open_socketcan(link));
    } else {
      buses.push_back(std::make_unique<PtyBus>(link, config.flexible));
    }
  }
  return buses;
}

void serveDrives(EmulatedBench& bench, const EmulatorConfig& config,
                 const std::vector<std::unique_ptr<CanBus>>& buses, const std::atomic<bool>* stop) {
  const WallClock::time_point start = WallClock::now();
  WallClock::time_point heard = start, last = start;
  bench.powerOn();
  sendAll(bench, buses);
  CanFrame frame;
  while (stop == nullptr || !stop->load()) {
    waitForAny(buses, kTick);
    const WallClock::time_point now = WallClock::now();
    if (!config.stepped) {
      bench.advanceTo((now - start) / nanoseconds(1));
    } else if (now - heard > kSilence || bench.owesAnswer()) {
      bench.idle((now - std::max(last, heard)) / nanoseconds(1));
    }
    last = now;
    for (std::size_t b = 0; b < buses.size(); ++b) {
      while (buses[b]->receive(frame)) {
        bench.onFrame(static_cast<int>(b), frame);
        heard = now;
      }
    }
    sendAll(bench, buses);
  }
}

}  // namespace ballbot
