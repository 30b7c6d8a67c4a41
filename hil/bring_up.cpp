#include "hil/bring_up.hpp"

#include <algorithm>

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

}  // namespace

void bringUp(Bench& bench, BenchIo& io, std::chrono::nanoseconds patience,
             const std::atomic<bool>* stop) {
  BenchMaster& master = bench.master();
  const auto cycle = std::chrono::nanoseconds(bench.config().cycle);
  // What was said before the reset, boot-up messages of switching on among it, is not for us.
  io.collect(std::chrono::steady_clock::now());
  master.reset();
  io.send();
  while (!master.configured()) {
    const auto until = std::chrono::steady_clock::now() + std::max(cycle, patience);
    if (!io.collect(until)) {
      master.endCycle();
      io.send();
    }
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
    throw LostParticipantError("bench", "bench: stopped, torque is off: " + bench.faultText());
  }
}

}  // namespace ballbot
