#include "hil/bring_up.hpp"

#include <chrono>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

void requireNoTrouble(const BenchMaster& master) {
  for (int i = 0; i <= kDriveCount; ++i) {
    const NodeLink& link = master.link(i);
    if (link.trouble() == NodeTrouble::kNone) continue;
    throw LostParticipantError("bench", "bench: set-up failed: " + link.troubleText());
  }
}

/// "still setting up, 120 of 410 steps; node 4: 12 of 61, 6072:00 max torque"
std::string progressText(const BenchMaster& master) {
  std::size_t done = 0, all = 0;
  std::string slowest;
  for (int i = 0; i <= kDriveCount; ++i) {
    done += master.link(i).stepsDone();
    all += master.link(i).stepCount();
    if (slowest.empty()) slowest = master.link(i).progressText();
  }
  return fmt::format("still setting up, {} of {} steps; {}", done, all, slowest);
}

}  // namespace

void bringUp(Bench& bench, BenchIo& io, int slowness, const std::atomic<bool>* stop,
             const std::function<void(const std::string&)>& say) {
  BenchMaster& master = bench.master();
  const auto cycle = slowness * std::chrono::nanoseconds(bench.config().cycle);
  // What was said before the reset, boot-up messages of switching on among it, is not for us.
  io.collect(std::chrono::steady_clock::now());
  master.reset();
  io.send();
  while (!master.configured()) {
    if (!io.collect(std::chrono::steady_clock::now() + cycle)) {
      master.endCycle();
      io.send();
    }
    if (say) say(progressText(master));
    requireNoTrouble(master);
    if (stop != nullptr && stop->load()) {
      throw InterruptedError("bench: stopped during set-up; no drive was switched on");
    }
    if (!io.allUp()) throw LostParticipantError("bench", "bench: a CAN bus is down");
  }
  master.start();
  io.send();
}

void requireGoodEnd(const Bench& bench) {
  if (!bench.torqueIsOff()) {
    const std::string why = bench.faultText();
    throw TorqueNotOffError("bench: " + bench.lastWord() +
                            (why.empty() ? "" : "It had stopped: " + why));
  }
  if (bench.safety().state() == SafetyState::kFault) {
    const char* end = bench.wayDown().underWay() ? "torque is off, as every drive has said"
                                                 : "no drive had been asked for torque";
    throw LostParticipantError("bench",
                               fmt::format("bench: stopped, {}: {}", end, bench.faultText()));
  }
}

}  // namespace ballbot
