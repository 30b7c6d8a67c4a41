#include "cosim/lifecycle.hpp"

#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/state_visitors.hpp"
#include "model/signal_check.hpp"

namespace ballbot {

namespace {

constexpr const char* kBlobKind = "participant";
constexpr std::uint32_t kBlobVersion = 1;

const char* wayOut(LifecycleState state) {
  switch (state) {
    case LifecycleState::kInstantiated:
      return "call enterInitializationMode first";
    case LifecycleState::kInitialization:
      return "call exitInitializationMode first";
    case LifecycleState::kStep:
      return "it is initialised already; reset leads back";
    case LifecycleState::kTerminated:
      return "call reset, then initialise again";
    case LifecycleState::kFailed:
      return "an earlier call failed; call reset or restoreState";
  }
  return "";
}

}  // namespace

void Lifecycle::demand(LifecycleCall call) const {
  if (allows(state_, call)) return;
  throw CallOrderError(toText(state_), toText(call),
                       fmt::format("{}: {} is not allowed in state '{}'; {}", name(), toText(call),
                                   toText(state_), wayOut(state_)));
}

// A call that throws leaves the participant in a state nobody knows.
template <typename Work>
void Lifecycle::attempt(Work&& work) {
  try {
    std::forward<Work>(work)();
  } catch (...) {
    state_ = LifecycleState::kFailed;
    throw;
  }
}

void Lifecycle::requirePossible(const char* when, SimTime time) const {
  std::string bad_sensor = firstImpossible(participant_.sensors(), time);
  if (bad_sensor.empty()) bad_sensor = firstNonFinite(participant_.added(AddedTo::kSensors));
  if (bad_sensor.empty()) return;
  // Our own plant finds its NaN before it answers.
  throw LostParticipantError(
      name(), fmt::format("{}: {} {}: {}", name(), when, ballbot::toText(time), bad_sensor));
}

void Lifecycle::enterInitializationMode(SimTime start) {
  demand(LifecycleCall::kEnterInitializationMode);
  attempt([&] { participant_.enterInitializationMode(start); });
  time_ = start;
  state_ = LifecycleState::kInitialization;
}

void Lifecycle::exitInitializationMode() {
  demand(LifecycleCall::kExitInitializationMode);
  attempt([&] {
    participant_.exitInitializationMode();
    requirePossible("at the start,", time_);
  });
  state_ = LifecycleState::kStep;
}

void Lifecycle::doStep(SimTime now, SimDuration step, const ActuatorCommand& command) {
  demand(LifecycleCall::kDoStep);
  if (now != time_) {
    throw CallOrderError(toText(state_), "doStep",
                         fmt::format("{}: doStep from {}, but it stands at {}", name(),
                                     ballbot::toText(now), ballbot::toText(time_)));
  }
  if (step.count() <= 0) {
    throw CallOrderError(
        toText(state_), "doStep",
        fmt::format("{}: doStep by {}, must be above 0", name(), ballbot::toText(step)));
  }
  const std::string bad_command = firstNonFinite(command);
  if (!bad_command.empty()) {
    throw NumericalError(
        fmt::format("{}: command at {}: {}", name(), ballbot::toText(now), bad_command));
  }
  attempt([&] {
    participant_.doStep(now, step, command);
    requirePossible("after the step to", now + step);
  });
  time_ = now + step;
}

void Lifecycle::terminate() {
  demand(LifecycleCall::kTerminate);
  attempt([&] { participant_.terminate(); });
  state_ = LifecycleState::kTerminated;
}

void Lifecycle::reset() {
  attempt([&] { participant_.reset(); });
  state_ = LifecycleState::kInstantiated;
  time_ = SimTime{};
}

const SensorFrame& Lifecycle::sensors() const {
  demand(LifecycleCall::kRead);
  return participant_.sensors();
}

std::optional<TruthFrame> Lifecycle::truth() const {
  demand(LifecycleCall::kRead);
  return participant_.truth();
}

std::uint64_t Lifecycle::stateDigest() const {
  demand(LifecycleCall::kRead);
  return participant_.stateDigest();
}

struct Lifecycle::Saved {
  LifecycleState state{};
  SimTime time{};
  StateBlob participant;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.state);
    visit(self.time);
    visit(self.participant);
  }
};

StateBlob Lifecycle::saveState() const {
  demand(LifecycleCall::kSaveState);
  return saveStateOf(Saved{state_, time_, participant_.saveState()}, kBlobKind, kBlobVersion);
}

void Lifecycle::restoreState(const StateBlob& blob) {
  demand(LifecycleCall::kRestoreState);
  Saved saved;
  restoreStateOf(saved, blob, kBlobKind, kBlobVersion);
  // A refused blob leaves the participant as it was, so the lifecycle state stays, too.
  participant_.restoreState(saved.participant);
  state_ = saved.state;
  time_ = saved.time;
}

}  // namespace ballbot
