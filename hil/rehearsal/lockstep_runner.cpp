#include "hil/rehearsal/lockstep_runner.hpp"

#include <future>

namespace ballbot {
namespace {

constexpr std::chrono::milliseconds kMoment{1}, kWhile{500};

}  // namespace

void LockstepRunner::pump() {
  if (clock_.loopWaits()) clock_.runCycle();
}

// A call that waits for the loop, which waits for us.
template <typename Call>
void LockstepRunner::whilePumping(Call call) {
  std::future<void> waiting = std::async(std::launch::async, std::move(call));
  while (waiting.wait_for(kMoment) != std::future_status::ready) {
    pump();
    // Its first sample is on its way to the call: commands begin with this very cycle.
    if (bench().safety().action() == SafetyAction::kFollow) waiting.wait_for(kWhile);
  }
  waiting.get();
}

// After a fault whoever asks hears how the way down ended, for which the loop must go on.
template <typename Call>
const BenchSample& LockstepRunner::whileItGoesDown(Call call) {
  if (!inner_.hasFault()) return call();
  const BenchSample* sample = nullptr;
  whilePumping([&] { sample = &call(); });
  return *sample;
}

const BenchSample& LockstepRunner::watch() {
  if (first_ == nullptr) {
    whilePumping([this] { first_ = &inner_.watch(); });
    return *first_;
  }
  pump();
  return whileItGoesDown([this]() -> const BenchSample& { return inner_.watch(); });
}

void LockstepRunner::engage() {
  whilePumping([this] { inner_.engage(); });
}

const BenchSample& LockstepRunner::sample(std::int64_t cycle) {
  if (cycle > 0) pump();
  return whileItGoesDown([&]() -> const BenchSample& { return inner_.sample(cycle); });
}

void LockstepRunner::release() noexcept {
  whilePumping([this] { inner_.release(); });
}

}  // namespace ballbot
