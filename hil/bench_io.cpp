#include "hil/bench_io.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include <poll.h>

namespace ballbot {

namespace {

// Drives that answer do so in less; for those that do not nobody waits who wants to stop.
constexpr std::chrono::milliseconds kHurry{50};

}  // namespace

BenchIo::BenchIo(BenchMaster& master, std::vector<CanBus*> buses)
    : master_(master), buses_(std::move(buses)), load_(buses_.size()) {}

void BenchIo::count(std::size_t bus, const CanFrame& frame) noexcept {
  const FrameBits bits = bitsOf(frame);
  load_[bus].nominal += bits.nominal;
  load_[bus].worst += bits.worst;
}

void BenchIo::send() noexcept {
  for (std::size_t i = 0; i < buses_.size(); ++i) {
    FrameQueue& queue = master_.outbox(static_cast<int>(i));
    for (const CanFrame& frame : queue) {
      if (buses_[i]->send(frame)) count(i, frame);
    }
    queue.clear();
  }
}

bool BenchIo::collect(std::chrono::steady_clock::time_point until,
                      const std::atomic<bool>* stop) noexcept {
  CanFrame frame;
  bool hurried = false;
  for (;;) {
    if (!hurried && stop != nullptr && stop->load()) {
      hurried = true;
      until = std::min(until, std::chrono::steady_clock::now() + kHurry);
    }
    for (std::size_t i = 0; i < buses_.size(); ++i) {
      while (buses_[i]->receive(frame)) {
        count(i, frame);
        master_.onFrame(static_cast<int>(i), frame);
      }
    }
    send();
    if (!master_.isAwaited()) return true;
    const auto left = until - std::chrono::steady_clock::now();
    if (left <= std::chrono::nanoseconds::zero() || !anyUp() || !wait(left)) return false;
  }
}

bool BenchIo::wait(std::chrono::nanoseconds timeout) noexcept {
  if (buses_.size() == 1) return buses_[0]->waitReadable(timeout);
  // Frames a bus has buffered already count too.
  std::array<pollfd, 2> entries{};
  for (std::size_t i = 0; i < buses_.size(); ++i) {
    entries[i].fd = -1;
    if (!buses_[i]->isUp()) continue;  // would be readable for ever
    if (buses_[i]->waitReadable(std::chrono::nanoseconds::zero())) return true;
    if (buses_[i]->descriptor() < 0) return false;
    entries[i] = {buses_[i]->descriptor(), POLLIN, 0};
  }
  const timespec time{timeout.count() / 1'000'000'000, timeout.count() % 1'000'000'000};
  const int ready = ::ppoll(entries.data(), static_cast<nfds_t>(buses_.size()), &time, nullptr);
  return ready > 0 || (ready < 0 && errno == EINTR);  // a signal is no end of waiting
}

bool BenchIo::anyUp() const noexcept {
  return std::any_of(buses_.begin(), buses_.end(), [](const CanBus* bus) { return bus->isUp(); });
}

bool BenchIo::allUp() const noexcept {
  for (const CanBus* bus : buses_) {
    if (!bus->isUp()) return false;
  }
  return true;
}

}  // namespace ballbot
