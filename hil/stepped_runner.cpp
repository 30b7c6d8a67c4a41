#include "hil/stepped_runner.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace ballbot {
namespace {

// Time-outs of the set-up are stretched by one for each of it: nothing moves meanwhile, and a busy
// machine is no fault of a drive. All of them together stay below the patience of whoever steps.
constexpr std::chrono::milliseconds kPatiencePerSlowness{1250};
// The robot may still swing when a session begins; then the bench waits for rest so long.
constexpr int kRestPatienceMs = 1000;
// While answers are missing nobody waits for them as long as for the first one.
constexpr std::chrono::milliseconds kShortPatience{50};
// Wall-clock time for the way down while drives answer, and what each cycle gets after it.
constexpr std::chrono::milliseconds kDownBudget{2000}, kLastPatience{5};

}  // namespace

SteppedRunner::SteppedRunner(const BenchConfig& config, std::vector<CanBus*> buses,
                             std::chrono::milliseconds patience, double recorded_s)
    : bench_(config),
      recorder_(config, nullptr, recorded_s),
      recorded_(buses, recorder_),
      io_(bench_.master(), recorded_.ends()),
      patience_(patience) {}

SteppedRunner::~SteppedRunner() { release(); }

std::chrono::milliseconds SteppedRunner::patience() const noexcept {
  const std::chrono::milliseconds now =
      answers_missing_ ? std::min(patience_, kShortPatience) : patience_;
  if (down_until_ == std::chrono::steady_clock::time_point{}) return now;
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
      down_until_ - std::chrono::steady_clock::now());
  return std::max(kLastPatience, std::min(now, left));
}

void SteppedRunner::sense() noexcept {
  bench_.master().beginCycle();
  recorder_.beginCycle(bench_.master().cycle());
  io_.send();
  answers_missing_ = !io_.collect(std::chrono::steady_clock::now() + patience(), stop_);
  bench_.master().endCycle();
  bench_.observe();
  actuated_ = false;
}

void SteppedRunner::actuate() noexcept {
  wishes_.bus_down = !io_.allUp();
  bench_.actuate(wishes_);
  io_.send();
  recorder_.endCycle(bench_, bench_.record());
  actuated_ = true;
}

// The clock stands still between calls, so the way down is carried to its end here.
void SteppedRunner::goDown() noexcept {
  wants_release_ = false;
  wishes_.command = nullptr;
  wishes_.stop = true;
  down_until_ = std::chrono::steady_clock::now() + kDownBudget;
  const int longest = bench_.config().safety.damping_cycles + bench_.wayDown().longest() + 4;
  for (int i = 0; i < longest; ++i) {
    if (!actuated_) actuate();
    if (bench_.isDown()) break;
    sense();
  }
  down_until_ = {};
}

void SteppedRunner::throwIfFault() {
  if (bench_.safety().state() != SafetyState::kFault) return;
  if (!bench_.isDown()) goDown();
  requireGoodEnd();
}

void SteppedRunner::throwIfStopped() {
  if (!stopWanted()) return;
  if (say_) say_("stopped by a person: torque is being called off");
  release();
  requireGoodEnd();
  throw InterruptedError("bench: stopped by a person; torque is off");
}

void SteppedRunner::start() {
  throwIfFault();
  if (running_) return;
  bringUp(bench_, io_, std::max(1, static_cast<int>(patience_ / kPatiencePerSlowness)), stop_,
          say_);
  running_ = true;
  sense();
}

const BenchSample& SteppedRunner::watch() {
  start();
  wishes_ = {};
  if (!actuated_) actuate();
  sense();
  throwIfFault();
  throwIfStopped();
  return bench_.master().sample();
}

void SteppedRunner::engage() {
  wants_release_ = true;
  start();
  wishes_ = {};
  wishes_.prepare = true;
  int waited = 0;
  const int rest_patience = bench_.config().cyclesOf(kRestPatienceMs);
  while (bench_.safety().state() != SafetyState::kEnabled ||
         !bench_.master().allDrives(DriveState::kOperationEnabled)) {
    wishes_.engage = bench_.safety().state() != SafetyState::kDisabled;
    if (!actuated_) actuate();
    throwIfFault();
    throwIfStopped();
    if (bench_.safety().engageRefused() && ++waited > rest_patience) {
      release();
      requireGoodEnd();
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
  wishes_.command_number = ++command_number_;
  actuate();
}

const BenchSample& SteppedRunner::sample(std::int64_t cycle) {
  while (cycle_ < cycle) {
    if (!actuated_) actuate();
    sense();
    ++cycle_;
    throwIfFault();
    throwIfStopped();
  }
  throwIfFault();
  return bench_.master().sample();
}

void SteppedRunner::release() noexcept {
  if (!running_ || !wants_release_) return;
  goDown();
  wishes_ = {};
}

}  // namespace ballbot
