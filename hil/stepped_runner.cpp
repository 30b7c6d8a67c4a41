#include "hil/stepped_runner.hpp"

#include <utility>

#include "core/error.hpp"
#include "hil/bring_up.hpp"

namespace ballbot {
namespace {

// The robot may still swing when a session begins; then the bench waits for rest so long.
constexpr int kRestPatience = 400;
// After the last torque: until the drives have confirmed that they are off.
constexpr int kFarewellCycles = 4;

}  // namespace

SteppedRunner::SteppedRunner(const BenchConfig& config, std::vector<CanBus*> buses,
                             std::chrono::milliseconds patience)
    : bench_(config), io_(bench_.master(), std::move(buses)), patience_(patience) {}

SteppedRunner::~SteppedRunner() { release(); }

void SteppedRunner::sense() noexcept {
  bench_.master().beginCycle();
  io_.send();
  io_.collect(std::chrono::steady_clock::now() + patience_);
  bench_.master().endCycle();
  bench_.observe();
  actuated_ = false;
}

void SteppedRunner::actuate() noexcept {
  wishes_.bus_down = !io_.allUp();
  bench_.actuate(wishes_);
  io_.send();
  actuated_ = true;
}

// The clock stands still between calls, so the stop is carried to its end here.
void SteppedRunner::throwIfFault() {
  if (bench_.safety().state() != SafetyState::kFault) return;
  wants_release_ = false;
  wishes_.command = nullptr;
  while (bench_.safety().action() != SafetyAction::kNoVoltage) {
    sense();
    actuate();
  }
  for (int i = 0; i < kFarewellCycles; ++i) {
    sense();
    actuate();
  }
  throw LostParticipantError("bench", "bench: stopped, torque is off: " + bench_.faultText());
}

void SteppedRunner::engage() {
  throwIfFault();
  wants_release_ = true;
  if (!running_) {
    bringUp(bench_, io_, patience_ / 100);
    running_ = true;
    sense();
  }
  wishes_ = {};
  wishes_.prepare = true;
  int waited = 0;
  while (bench_.safety().state() != SafetyState::kEnabled ||
         !bench_.master().allDrives(DriveState::kOperationEnabled)) {
    wishes_.engage = bench_.safety().state() != SafetyState::kDisabled;
    if (!actuated_) actuate();
    throwIfFault();
    if (bench_.safety().engageRefused() && ++waited > kRestPatience) {
      release();
      throw LostParticipantError("bench", "bench: the robot does not come to rest; not engaged");
    }
    sense();
  }
  cycle_ = 0;
}

void SteppedRunner::command(std::int64_t cycle, const BenchCommand& command) {
  if (cycle != cycle_ || actuated_) return;  // within a cycle only the first command can act
  command_ = command;
  wishes_.command = &command_;
  actuate();
}

const BenchSample& SteppedRunner::sample(std::int64_t cycle) {
  while (cycle_ < cycle) {
    if (!actuated_) actuate();
    sense();
    ++cycle_;
    throwIfFault();
  }
  throwIfFault();
  return bench_.master().sample();
}

void SteppedRunner::release() noexcept {
  if (!running_ || !wants_release_) return;
  wants_release_ = false;
  wishes_.stop = true;
  wishes_.command = nullptr;
  int left = kFarewellCycles;
  const int longest = bench_.config().safety.damping_cycles + 2 * kFarewellCycles;
  for (int i = 0; i < longest && left > 0; ++i) {
    if (!actuated_) actuate();
    sense();
    if (bench_.safety().action() == SafetyAction::kNoVoltage) --left;
  }
  wishes_ = {};
}

}  // namespace ballbot
