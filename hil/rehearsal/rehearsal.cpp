#include "hil/rehearsal/rehearsal.hpp"

#include <utility>

#include "core/yaml_file.hpp"
#include "hil/emulator/joint_rig.hpp"
#include "hil/realtime_runner.hpp"
#include "hil/stepped_runner.hpp"

namespace ballbot {
namespace {

// Until the drives have booted, have been set up and enabled, many times over.
constexpr int kEngagePatience = 4000;
constexpr std::chrono::milliseconds kMoment{2};
constexpr std::uint32_t kSync = 0x080;
constexpr double kRecordedSeconds = 1;  // a trial is short, and there are hundreds

EmulatorConfig emulatorFor(const BenchConfig& config,
                           const std::function<void(EmulatorConfig&)>& change) {
  EmulatorConfig e;
  e.cycle = config.cycle;
  e.stepped = true;
  e.bus_count = static_cast<int>(config.buses.size());
  for (std::size_t i = 0; i < e.drives.size(); ++i) {
    e.drives[i].node = config.drives[i].node;
    e.drive_bus[i] = config.drives[i].bus;
  }
  e.imu_bus = config.imu.bus;
  e.imu_node = config.imu.node;
  if (change) change(e);
  return e;
}

}  // namespace

const char* toText(RunnerKind kind) noexcept {
  return kind == RunnerKind::kStepped ? "stepped" : "real time";
}

BenchConfig Rehearsal::defaultConfig() {
  return readBenchConfig(
      parseYaml("{stepped: true, buses: [{address: none}, {address: none}], drives: [{node: 1}, "
                "{node: 2}, {node: 3}, {node: 4, bus: 1}, {node: 5, bus: 1}, {node: 6, bus: 1}]}",
                "rehearsal"));
}

Rehearsal::Rehearsal(const BenchConfig& config, RunnerKind kind,
                     const std::function<void(EmulatorConfig&)>& change)
    : Rehearsal(config, kind, emulatorFor(config, change),
                std::make_unique<JointRig>(JointRigOptions{})) {}

Rehearsal::Rehearsal(const BenchConfig& config, RunnerKind kind, const EmulatorConfig& emulator,
                     std::unique_ptr<JointRig> rig)
    : kind_(kind),
      config_(config),
      rig_(rig.get()),
      drives_(emulator, std::move(rig)),
      torque_(drives_) {
  config_.stepped = kind == RunnerKind::kStepped;
  std::vector<CanBus*> ends;
  for (int i = 0; i < static_cast<int>(config.buses.size()); ++i) {
    buses_.push_back(std::make_unique<EmulatedBus>(drives_, i));
    wires_.push_back(std::make_unique<TamperedBus>(*buses_.back()));
    ends.push_back(wires_.back().get());
  }
  wires_[0]->beforeSend([this](const CanFrame& f) {
    if (f.id == kSync) torque_.onCycleEnd();
  });
  if (kind == RunnerKind::kStepped) {
    runner_ =
        std::make_unique<SteppedRunner>(config_, ends, std::chrono::seconds(5), kRecordedSeconds);
  } else {
    auto runner = std::make_unique<RealtimeRunner>(config_, ends, &clock_, kRecordedSeconds);
    realtime_ = runner.get();
    lockstep_ = std::make_unique<LockstepRunner>(*realtime_, clock_);
    runner_ = std::move(runner);
  }
  runner_->setStopFlag(&stop_);
  drives_.powerOn();
}

Rehearsal::~Rehearsal() { finish(); }

const Bench& Rehearsal::bench() const { return runner_->bench(); }

void Rehearsal::note(const std::exception_ptr& error) {
  ended_ = true;
  try {
    std::rethrow_exception(error);
  } catch (const Error& e) {
    if (why_.empty()) why_ = e.what();
    exit_code_ = e.exitCode();
  }
}

// Calls of the real-time runner wait for its loop, which waits for us.
template <typename Call>
void Rehearsal::inTheBackground(Call call) {
  waiting_ = std::async(std::launch::async, std::move(call));
}

// Or the loop would run on for as long as a thread takes to start.
void Rehearsal::awaitStop() {
  for (int i = 0; i < kEngagePatience && !realtime_->stopAsked(); ++i) {
    if (waiting_.wait_for(kMoment) == std::future_status::ready) return;
  }
}

void Rehearsal::pump() {
  if (clock_.loopWaits()) clock_.runCycle();
}

bool Rehearsal::engage() {
  try {
    runner().engage();
    return true;
  } catch (const Error&) {
    note(std::current_exception());
    return false;
  }
}

void Rehearsal::cycle(const BenchCommand* command) {
  if (ended_) {
    if (realtime_ != nullptr) {
      pump();
    } else {
      cycleWithoutMaster();
    }
    return;
  }
  try {
    if (command != nullptr) runner_->command(at_, *command);
    if (realtime_ != nullptr) pump();
    // Its answer waits for the way down, which is pumped.
    if (realtime_ != nullptr && (stop_ || realtime_->hasFault())) {
      ended_ = true;
      inTheBackground([this] { runner_->sample(at_ + 1); });
      awaitStop();
      return;
    }
    const bool samples = realtime_ == nullptr ||
                         bench().safety().state() == SafetyState::kEnabled ||
                         bench().safety().state() == SafetyState::kFault;
    if (samples) runner_->sample(++at_);
  } catch (const Error&) {
    note(std::current_exception());
  }
}

void Rehearsal::interrupt() { stop_ = true; }

void Rehearsal::cycleWithoutMaster() {
  torque_.onCycleEnd();
  for (int b = 0; b < static_cast<int>(buses_.size()); ++b) {
    drives_.onFrame(b, CanFrame{kSync, false, false, 0, {}});
    drives_.outbox(b).clear();
  }
}

void Rehearsal::oversleep(int periods) {
  clock_.oversleep(periods * config_.cycle.count());
  for (int i = 0; i < periods; ++i) cycleWithoutMaster();
}

void Rehearsal::finish() {
  if (finished_) return;
  finished_ = true;
  try {
    if (realtime_ != nullptr) {
      if (!waiting_.valid()) inTheBackground([this] { runner_->release(); });
      awaitStop();
      const int longest = config_.safety.damping_cycles + bench().wayDown().longest() + 8;
      for (int i = 0; i < longest; ++i) {
        // A call that has thrown does not wait for the way down, which is to end by cycles and not
        // by letting go.
        const bool answered =
            waiting_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        if (answered && bench().isDown()) break;
        pump();
        waiting_.wait_for(bench().isDown() ? kMoment : std::chrono::milliseconds(0));
      }
      clock_.letGo();
      realtime_->finish();
      waiting_.get();
    } else {
      runner_->release();
    }
    runner_->requireGoodEnd();
  } catch (const Error&) {
    note(std::current_exception());
  }
  if (realtime_ != nullptr) {
    try {
      runner_->requireGoodEnd();
    } catch (const Error&) {  // graver than what a call had thrown before
      note(std::current_exception());
    }
  }
  torque_.onCycleEnd();
}

void Rehearsal::pullBus1() {
  buses_[1]->pull();
  drives_.inject({0, EmulatedFault::kFrozenBus, 3, 0});
}

}  // namespace ballbot
