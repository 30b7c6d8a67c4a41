#pragma once

#include <memory>
#include <vector>

#include "hil/bench.hpp"
#include "hil/bench_io.hpp"
#include "hil/emulator/emulated_bench.hpp"
#include "hil/emulator/emulated_bus.hpp"

namespace ballbot {

/// A bench and the emulated drives it talks to in one process, stepped, with joints on a test rig
/// in the robot's place: what can go wrong on a bench, tried out without one.
class Rehearsal {
 public:
  /// Three drives and the IMU on one bus, three drives on another.
  /// @param config  its buses and drives are used, its addresses are not
  explicit Rehearsal(const BenchConfig& config);

  /// Two buses, six drives, the defaults of everything else.
  static BenchConfig defaultConfig();

  /// Brings everything up and engages. False, with the bench in fault, if that fails.
  bool engage();
  /// One cycle with this command.
  void cycle(const BenchCommand& command);
  /// SYNC goes on, but the master says nothing else: as if its process hung.
  void cycleWithoutMaster();

  Bench& bench() { return bench_; }
  EmulatedBench& drives() { return drives_; }
  Bench::Wishes& wishes() { return wishes_; }
  /// As if the adapter of bus 1, the arm's, had been pulled out.
  void pullBus1();
  /// A motor still has torque, or is still switched on.
  bool torqueOn() const { return drives_.largestTorque() > 0 || drives_.anyEnergized(); }

 private:
  BenchConfig config_;
  EmulatedBench drives_;
  Bench bench_;
  std::vector<std::unique_ptr<EmulatedBus>> buses_;
  BenchIo io_;
  Bench::Wishes wishes_;
};

}  // namespace ballbot
