#include "hil/emulator/serve_drives.hpp"

#include <array>
#include <chrono>

#include <poll.h>

#include "hil/emulator/pty_bus.hpp"

namespace ballbot {
namespace {

using WallClock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kTick = milliseconds(1);  // of time without frames, in real time

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
      buses.push_back(std::make_unique<PtyBus>(link));
    }
  }
  return buses;
}

void serveDrives(EmulatedBench& bench, const EmulatorConfig& config,
                 const std::vector<std::unique_ptr<CanBus>>& buses, const std::atomic<bool>* stop) {
  const WallClock::time_point start = WallClock::now();
  bench.powerOn();
  sendAll(bench, buses);
  CanFrame frame;
  while (stop == nullptr || !stop->load()) {
    waitForAny(buses, config.stepped ? milliseconds(100) : kTick);
    if (!config.stepped) bench.advanceTo((WallClock::now() - start) / nanoseconds(1));
    for (std::size_t b = 0; b < buses.size(); ++b) {
      while (buses[b]->receive(frame)) bench.onFrame(static_cast<int>(b), frame);
    }
    sendAll(bench, buses);
  }
}

}  // namespace ballbot
