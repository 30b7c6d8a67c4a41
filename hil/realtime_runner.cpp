#include "hil/realtime_runner.hpp"

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "core/error.hpp"
#include "hil/bring_up.hpp"

namespace ballbot {
namespace {

constexpr std::size_t kCommands = 64, kSamples = 1024, kRecords = 8192;
constexpr std::int64_t kLeadNs = 5'000'000;  // from starting the thread to its first deadline
constexpr int kRestPatienceMs = 5000;
constexpr long kNewsTimeoutNs = 20'000'000;
// For a loop that is late on the way down, beyond the cycles that it takes.
constexpr std::int64_t kDownMarginNs = 500'000'000;

}  // namespace

RealtimeRunner::RealtimeRunner(const BenchConfig& config, std::vector<CanBus*> buses,
                               LoopClock* clock, double recorded_s)
    : clock_(clock != nullptr ? *clock : wall_clock_),
      bench_(config),
      recorder_(config, &clock_, recorded_s),
      answers_(config),
      recorded_(buses, recorder_, &answers_),
      io_(bench_.master(), recorded_.ends()),
      commands_(kCommands),
      samples_(kSamples),
      records_(kRecords) {
  ::sem_init(&news_, 0, 0);
}

RealtimeRunner::~RealtimeRunner() {
  finish();
  ::sem_destroy(&news_);
}

void RealtimeRunner::finish() noexcept {
  release();
  running_ = false;  // from here on release() has nothing to wait for
  if (thread_.joinable()) thread_.join();
}

// False after a while without news, so that the caller looks at the state anyway.
bool RealtimeRunner::waitForNews() noexcept {
  timespec until{};
  ::clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += kNewsTimeoutNs;
  if (until.tv_nsec >= 1'000'000'000) {
    until.tv_nsec -= 1'000'000'000;
    ++until.tv_sec;
  }
  return ::sem_timedwait(&news_, &until) == 0;
}

void RealtimeRunner::throwIfFault() {
  if (state_.load(std::memory_order_acquire) != SafetyState::kFault) return;
  release();  // its loop takes the torque off; whoever asks hears how that ended
  requireGoodEnd();
}

void RealtimeRunner::throwIfStopped() {
  if (!stopWanted()) return;
  if (say_) say_("stopped by a person: torque is being called off");
  release();
  requireGoodEnd();
  throw InterruptedError("bench: stopped by a person; torque is off");
}

// What is to be said is the loop's until it has ended; a fault is latched, so nothing is lost by
// it.
void RealtimeRunner::requireGoodEnd() {
  if (state_.load(std::memory_order_acquire) != SafetyState::kFault && down_) return;
  finish();
  ballbot::requireGoodEnd(bench_);
}

void RealtimeRunner::start() {
  throwIfFault();
  if (running_) return;
  bringUp(bench_, io_, 1, stop_, say_);
  running_ = true;
  thread_ = std::thread([this] { loop(); });
}

const BenchSample& RealtimeRunner::watch() {
  watching_ = true;
  start();
  while (!samples_.pop(last_)) {
    throwIfFault();
    throwIfStopped();
    waitForNews();
  }
  return last_.sample;
}

void RealtimeRunner::engage() {
  watching_ = false;
  start();
  while (samples_.pop(last_)) {  // of an earlier session
  }
  want_stop_ = false;
  want_torque_ = true;
  const std::int64_t begun = clock_.now();
  for (;;) {
    waitForNews();
    throwIfFault();
    throwIfStopped();
    if (samples_.pop(last_)) return;
    if (say_) say_("waiting for drives that are enabled and a robot at rest");
    if (clock_.now() - begun > kRestPatienceMs * 1'000'000LL) {
      release();
      throw LostParticipantError(
          "bench", engage_refused_ ? "bench: the robot does not come to rest; not engaged"
                                   : "bench: the drives do not become enabled; not engaged");
    }
  }
}

void RealtimeRunner::command(std::int64_t, const BenchCommand& command) {
  commands_.push(command);  // full: the loop is far behind, and older commands are as good
}

const BenchSample& RealtimeRunner::sample(std::int64_t cycle) {
  while (last_.cycle < cycle) {
    if (samples_.pop(last_)) continue;
    throwIfFault();
    throwIfStopped();
    waitForNews();
  }
  throwIfFault();
  throwIfStopped();
  return last_.sample;
}

void RealtimeRunner::release() noexcept {
  if (!running_) return;
  want_torque_ = false;
  want_stop_ = true;
  const int longest = bench_.config().safety.damping_cycles + bench_.wayDown().longest() + 4;
  const std::int64_t until = clock_.now() + longest * bench_.config().cycle.count() + kDownMarginNs;
  while (clock_.now() < until) {
    const SafetyState state = state_;
    if (down_ && (state == SafetyState::kDisabled || state == SafetyState::kFault)) break;
    waitForNews();
  }
}

void RealtimeRunner::takeCommands() noexcept {
  bool fresh = false;
  while (commands_.pop(command_)) fresh = true;
  if (fresh) {
    wishes_.command = &command_;
    wishes_.command_number = ++command_number_;
  } else if (bench_.safety().action() == SafetyAction::kFollow) {
    ++statistics_.commands_missing;
  }
}

// From SYNC to SYNC: a loop that woke late has let periods pass that its schedule has not skipped.
int RealtimeRunner::periodsSinceLast(std::int64_t woke_ns) noexcept {
  const std::int64_t period = bench_.config().cycle.count();
  const std::int64_t since = last_woke_ns_ == 0 ? period : woke_ns - last_woke_ns_;
  last_woke_ns_ = woke_ns;
  return static_cast<int>(std::max<std::int64_t>(1, (since + period / 2) / period));
}

void RealtimeRunner::cycle(std::int64_t deadline_ns) noexcept {
  const BenchConfig& config = bench_.config();
  const std::int64_t woke = clock_.now();
  BenchMaster& master = bench_.master();
  io_.collect(std::chrono::steady_clock::time_point{});  // answers to the SYNC before: too late
  master.beginCycle();
  recorder_.beginCycle(master.cycle());
  io_.send();
  const std::int64_t synced = clock_.now();
  // steady_clock is CLOCK_MONOTONIC in this library.
  io_.collect(std::chrono::steady_clock::time_point(std::chrono::nanoseconds(deadline_ns) +
                                                    config.realtime.collect));
  const std::int64_t answered = clock_.now();
  answers_.endCycle();
  master.endCycle();
  bench_.observe(periodsSinceLast(woke) - 1);

  const bool torque = bench_.safety().state() == SafetyState::kEnabled;
  if (!torque) session_cycle_ = -1;
  if (torque && (session_cycle_ >= 0 || master.allDrives(DriveState::kOperationEnabled))) {
    session_cycle_ += 1 + (session_cycle_ >= 0 ? skipped_now_ : 0);
    samples_.push({session_cycle_, master.sample()});
    ::sem_post(&news_);
  } else if (watching_) {
    samples_.push({session_cycle_, master.sample()});
    ::sem_post(&news_);
  }

  const std::int64_t judged = clock_.now();
  clock_.sleepUntil(deadline_ns + config.realtime.act.count());
  const std::int64_t woke_to_act = clock_.now();
  takeCommands();
  wishes_.prepare = !watching_;
  wishes_.engage = want_torque_;
  wishes_.stop = want_stop_;
  wishes_.bus_down = !io_.allUp();
  wishes_.skipped_cycles = skipped_now_;
  if (!torque) wishes_.command = nullptr;  // commands that come too early are refused
  bench_.actuate(wishes_);
  io_.send();
  const std::int64_t acted = clock_.now();

  statistics_.wake.add(woke - deadline_ns);
  statistics_.act.add(acted - deadline_ns);
  LoopTimes& times = statistics_.times;
  times.act_wake.add(woke_to_act - deadline_ns - config.realtime.act.count());
  times.sync_out.add(synced - woke);
  times.judge.add(judged - answered);
  times.act.add(acted - woke_to_act);
  times.own.add(synced - woke + judged - answered + acted - woke_to_act);
  ++statistics_.cycles;
  CycleRecord record = bench_.record();
  record.wake_late_ns = static_cast<std::int32_t>(woke - deadline_ns);
  record.act_late_ns = static_cast<std::int32_t>(acted - deadline_ns - config.realtime.act.count());
  if (!records_.push(record)) ++statistics_.records_lost;
  recorder_.endCycle(bench_, record);
  engage_refused_ = bench_.safety().engageRefused();
  down_ = bench_.isDown();
  if (state_.exchange(bench_.safety().state(), std::memory_order_release) !=
      bench_.safety().state()) {
    ::sem_post(&news_);
  }
}

void RealtimeRunner::loop() noexcept {
  statistics_.grant = clock_.prepareThread(bench_.config().realtime.priority);
  DeadlineSchedule schedule(clock_.now() + kLeadNs, bench_.config().cycle.count());
  while (running_) {
    clock_.sleepUntil(schedule.deadline());
    cycle(schedule.deadline());
    skipped_now_ = static_cast<int>(schedule.advance(clock_.now()));
    const auto last = static_cast<int>(statistics_.misses.size()) - 1;
    if (skipped_now_ > 0) {
      ++statistics_.misses[static_cast<std::size_t>(std::min(skipped_now_, last))];
    }
  }
  statistics_.overruns = schedule.overruns();
  statistics_.skipped = schedule.skipped();
  clock_.leaveThread();
}

}  // namespace ballbot
