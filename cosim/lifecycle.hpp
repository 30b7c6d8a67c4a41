#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "cosim/lifecycle_state.hpp"
#include "cosim/participant.hpp"

namespace ballbot {

/// A participant whose contract is enforced: the call order, that steps follow one another without
/// gap, that commands are finite and
/// results possible. What is wrapped may rely on it, and whoever calls is
/// told in words what was wrong.
///
///   call                      allowed in                      leads to
///   enterInitializationMode   instantiated                    initialization
///   exitInitializationMode    initialization                  step
///   doStep                    step                            step
///   terminate                 step                            terminated
///   reset                     any                             instantiated
///   sensors, truth            step, terminated
///   saveState                 initialization, step, terminated
///   restoreState              initialization, step,           the state it was saved in
///                             terminated, failed
///
/// @throw CallOrderError (all calls) naming participant, state and call.
class Lifecycle final : public Participant {
 public:
  /// `participant` must outlive this.
  explicit Lifecycle(Participant& participant) : participant_(participant) {}
  /// Keeps the participant as its own.
  explicit Lifecycle(std::unique_ptr<Participant> participant)
      : owned_(std::move(participant)), participant_(*owned_) {}

  LifecycleState state() const { return state_; }
  /// The time reached.
  SimTime time() const { return time_; }

  std::string name() const override { return participant_.name(); }
  void enterInitializationMode(SimTime start) override;
  void exitInitializationMode() override;
  /// @throw CallOrderError also if `now` is not the time reached or `step` is not positive;
  ///        NumericalError if the command is not finite, LostParticipantError if a sensor value
  ///        after the step is impossible (model/signal_check.hpp).
  void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) override;
  void terminate() override;
  void reset() override;
  const SensorFrame& sensors() const override;
  std::optional<TruthFrame> truth() const override;
  const AddedSignals& added(AddedTo frame) const override { return participant_.added(frame); }
  /// The participant's state together with time and lifecycle state.
  StateBlob saveState() const override;
  void restoreState(const StateBlob& blob) override;
  std::uint64_t stateDigest() const override;

 private:
  struct Saved;
  void demand(LifecycleCall call) const;
  void requirePossible(const char* when, SimTime time) const;
  template <typename Work>
  void attempt(Work&& work);

  std::unique_ptr<Participant> owned_;
  Participant& participant_;
  LifecycleState state_ = LifecycleState::kInstantiated;
  SimTime time_{};
};

}  // namespace ballbot
