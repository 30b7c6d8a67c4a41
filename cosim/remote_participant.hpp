#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cosim/participant.hpp"
#include "cosim/retransmission.hpp"
#include "cosim/step_client.hpp"
#include "cosim/transport.hpp"

namespace ballbot {

struct RemoteOptions {
  std::string name = "plant";  ///< who is at the far end, for messages
  std::uint64_t config_digest = 0;
  /// Silence after which the far end counts as lost; the first reply may take longer, since the
  /// process may still be starting.
  std::chrono::milliseconds patience{10'000};
  std::chrono::milliseconds first_patience{30'000};
  /// Beside the participant's sensors and truth, without values: both ends have these lists from
  /// the same configuration.
  PerAddedTo<AddedSignals> added;
  /// Asked between tries: why the far end is known to be gone ("exited with code 2"), or empty.
  std::function<std::string()> peer_trouble;
  /// Words for a person while the far end is long at work: "plant is busy: setting up the drives".
  std::function<void(const std::string&)> say;
  /// Set by a signal handler: give up at once with InterruptedError.
  const std::atomic<bool>* stop = nullptr;
};

/// A participant in another process, reached by the step protocol. The master cannot tell it from
/// one in its own process.
///
/// Calls throw what the participant throws at the far end, as an Error of the same exit code, and:
/// @throw LostParticipantError nobody answers, or the far end is known to be gone
/// @throw InputError the far end refused: other version, other configuration, in use by another
///        run, or two participants answer
/// @throw NumericalError a reply says what cannot be: another time than the one asked for, a number
///        that is not finite or beyond all reason (model/signal_check.hpp)
class RemoteParticipant final : public Participant {
 public:
  /// `transport` must outlive this.
  RemoteParticipant(Transport& transport, RemoteOptions options);
  /// Tells the far end to stop if its session is still open; waits 100 ms at most.
  ~RemoteParticipant() override;

  std::string name() const override { return options_.name; }
  void enterInitializationMode(SimTime start) override;
  void exitInitializationMode() override {}
  void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) override;
  void terminate() override;
  void reset() override;
  const SensorFrame& sensors() const override { return sensors_; }
  std::optional<TruthFrame> truth() const override { return truth_; }
  const AddedSignals& added(AddedTo frame) const override { return options_.added[frame]; }
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;
  std::uint64_t stateDigest() const override { return state_digest_; }

  /// Facts of the machine, for timing.json.
  struct LinkStatistics {
    std::int64_t requests = 0;  ///< distinct ones
    std::int64_t repeated = 0;  ///< sent again
    IgnoredMessages ignored;
  };
  LinkStatistics statistics() const;

 private:
  void exchange(WallDuration patience,
                WallDuration longest_wait = RetransmissionTimer::kLongest) const;
  bool replyBy(WallClock::time_point until, WallClock::time_point& now) const;
  void adoptReply(SimTime expected);
  void adoptAdded(AddedTo frame, const std::vector<double>& values);
  [[noreturn]] void throwUnbelievable(const std::string& what) const;
  void throwUnlessOk() const;
  [[noreturn]] void throwLost(WallDuration waited, int tries) const;

  Transport& transport_;
  RemoteOptions options_;
  // saveState() is const to its caller, yet it talks.
  mutable std::unique_ptr<StepClient> client_;
  mutable RetransmissionTimer timer_;
  mutable LinkStatistics statistics_;
  mutable Bytes received_;
  mutable WallClock::time_point
      patient_since_{};  ///< the request, or the last sign of life after it
  bool reset_pending_ = false;
  SensorFrame sensors_;
  std::optional<TruthFrame> truth_;
  std::uint64_t state_digest_ = 0;
};

}  // namespace ballbot
