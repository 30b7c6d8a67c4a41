#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "hil/bench_runner.hpp"
#include "hil/emulator/emulated_bench.hpp"
#include "hil/emulator/emulated_bus.hpp"
#include "hil/emulator/joint_rig.hpp"
#include "hil/rehearsal/lockstep_clock.hpp"
#include "hil/rehearsal/lockstep_runner.hpp"
#include "hil/rehearsal/tampered_bus.hpp"
#include "hil/rehearsal/torque_watch.hpp"

namespace ballbot {

/// Which of the two runners a rehearsal tries.
enum class RunnerKind { kStepped, kRealTime };
const char* toText(RunnerKind kind) noexcept;

/// A runner of the bench, with all that belongs to it, and the emulated drives it talks to in one
/// process, with joints on a test rig in the robot's place: what can go wrong on a bench, tried out
/// without one. The real-time loop is its own thread, in lockstep with whoever calls.
class Rehearsal {
 public:
  /// Three drives and the IMU on one bus, three drives on another.
  /// @param config  its buses and drives are used, its addresses are not
  /// @param change  of the emulated drives, which otherwise are as config says
  Rehearsal(const BenchConfig& config, RunnerKind kind,
            const std::function<void(EmulatorConfig&)>& change = {});
  ~Rehearsal();

  /// Two buses, six drives, the defaults of everything else.
  static BenchConfig defaultConfig();

  /// Brings everything up and engages. False, with why(), if that fails.
  bool engage();
  /// One cycle with this command; null: the controller says nothing. Once the run has ended, what
  /// the runner still does by itself; then SYNC alone.
  void cycle(const BenchCommand* command);
  /// As if a person had pressed Ctrl-C.
  void interrupt();
  /// SYNC goes on, but the master says nothing else: as if its process hung.
  void cycleWithoutMaster();
  /// The real-time loop oversleeps so many periods, which pass for the drives.
  void oversleep(int periods);
  /// What `ballbot hil` does at the end of a run: release, and the last word of it.
  void finish();
  /// As if the adapter of bus 1, the arm's, had been pulled out.
  void pullBus1();

  /// The runner has thrown: the run is over.
  bool ended() const { return ended_; }
  /// What it said, and with which exit code the program would end; kPassed before finish().
  const std::string& why() const { return why_; }
  ExitCode exitCode() const { return exit_code_; }

  RunnerKind kind() const { return kind_; }
  const Bench& bench() const;
  /// After finish().
  const FlightRecorder& recorder() const { return runner_->recorder(); }
  EmulatedBench& drives() { return drives_; }
  TamperedBus& wire(int bus) { return *wires_[static_cast<std::size_t>(bus)]; }
  TorqueWatch& torque() { return torque_; }
  JointRig& rig() { return *rig_; }
  /// For whoever calls it in turn, in either runner.
  BenchRunner& runner() { return lockstep_ ? static_cast<BenchRunner&>(*lockstep_) : *runner_; }

 private:
  Rehearsal(const BenchConfig& config, RunnerKind kind, const EmulatorConfig& emulator,
            std::unique_ptr<JointRig> rig);
  void note(const std::exception_ptr& error);
  void pump();
  void awaitStop();
  template <typename Call>
  void inTheBackground(Call call);

  RunnerKind kind_;
  BenchConfig config_;
  JointRig* rig_;  ///< of drives_
  EmulatedBench drives_;
  std::vector<std::unique_ptr<EmulatedBus>> buses_;
  std::vector<std::unique_ptr<TamperedBus>> wires_;
  TorqueWatch torque_;
  LockstepClock clock_;
  std::atomic<bool> stop_{false};
  std::unique_ptr<BenchRunner> runner_;
  RealtimeRunner* realtime_ = nullptr;        ///< runner_, where it is one
  std::unique_ptr<LockstepRunner> lockstep_;  ///< around it
  std::future<void> waiting_;                 ///< a call of the runner that waits for its loop
  std::int64_t at_ = 0;
  bool ended_ = false, finished_ = false;
  std::string why_;
  ExitCode exit_code_ = ExitCode::kPassed;
};

}  // namespace ballbot
