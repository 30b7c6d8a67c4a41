#pragma once

#include "cosim/participant.hpp"
#include "hil/bench_runner.hpp"

namespace ballbot {

/// Real drives (or emulated ones) in the plant's place: the bench as a participant of the step
/// protocol. Its time is the number of bus cycles since the drives were enabled; the command that
/// is in force when a cycle begins is the one that is sent. A step has a longest length: a command
/// may not be in force for longer than the watchdog would let it.
///
/// State cannot be saved: saveState() and restoreState() throw.
class HilParticipant final : public Participant {
 public:
  /// `runner` must outlive this.
  explicit HilParticipant(BenchRunner& runner);

  std::string name() const override { return "hil"; }
  void enterInitializationMode(SimTime start) override;
  void exitInitializationMode() override {}
  void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) override;
  /// @throw TorqueNotOffError, LostParticipantError: a run whose way down failed has not passed.
  void terminate() override;
  void reset() override { runner_.release(); }
  const SensorFrame& sensors() const override { return sensors_; }
  /// Nobody knows the truth about a real robot.
  std::optional<TruthFrame> truth() const override { return std::nullopt; }
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;
  /// Hash of what was measured so far: equal runs in stepped mode have equal ones.
  std::uint64_t stateDigest() const override { return digest_; }

 private:
  void requireShort(SimDuration step) const;
  void adopt(const BenchSample& sample, std::int64_t cycle);

  BenchRunner& runner_;
  SimDuration period_;
  SimTime start_{};
  std::int64_t cycle_ = 0, first_imu_count_ = 0;
  SensorFrame sensors_;
  std::uint64_t digest_ = 0;
};

}  // namespace ballbot
