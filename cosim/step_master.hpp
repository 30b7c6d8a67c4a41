#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "cosim/participant.hpp"
#include "cosim/recorder.hpp"
#include "cosim/schedule.hpp"
#include "cosim/stepped_controller.hpp"
#include "cosim/tick.hpp"

namespace ballbot {

struct MasterOptions {
  SimTime start = kSimStart;
  SimTime end{};  ///< the last event is here at the latest
  /// Set by a signal handler: stop with InterruptedError before the next event.
  const std::atomic<bool>* stop = nullptr;
};

/// Whole state of a run between two events.
struct Checkpoint {
  SimTime time{};
  std::int64_t tick = 0;    ///< number of the next event
  ActuatorCommand command;  ///< in force
  StateBlob participant, controller;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.time);
    visit(self.tick);
    visit(self.command);
    visit(self.participant);
    visit(self.controller);
  }

  StateBlob toBlob() const;
  /// @throw InputError as restoreStateOf().
  static Checkpoint fromBlob(const StateBlob& blob);
};

/// Moves simulated time: at each event of the calendar it reads the sensors, lets the controller
/// compute a command, records, and advances the participant to the next event. The participant may
/// be in this process (plant, FMU) or in another (RemoteParticipant).
class StepMaster {
 public:
  /// All must outlive this; `recorder` may be null. A participant in this process comes wrapped in
  /// a Lifecycle, one in another process has it there.
  /// @throw InputError if the run would not end after its start.
  StepMaster(Participant& participant, SteppedController& controller, const EventCalendar& calendar,
             Recorder* recorder, MasterOptions options);

  /// Called at every event after the controller; return false to end the run there. It may look at
  /// the truth: it judges the run, it does not control.
  using Observer = std::function<bool(const Tick&)>;
  void setObserver(Observer observer) { observer_ = std::move(observer); }

  enum class End { kDuration, kObserver };
  /// From the first event to the last, then ends the participant's session.
  /// @throw whatever participant and recorder throw; LostParticipantError for a NaN command;
  ///        InterruptedError if the stop flag was set.
  End run();

  // The same in pieces.
  void initialize();
  /// Processes the event at time() and, unless it was the last, advances to the next. False after
  /// the last.
  bool step();
  void terminate();
  SimTime time() const { return time_; }
  std::int64_t tick() const { return tick_; }
  std::optional<End> ended() const { return ended_; }

  /// Between two events, i.e. before step(): everything needed to continue bit for bit.
  Checkpoint save() const;
  /// Continues from a checkpoint; call it instead of initialize() in a new run, or in a running
  /// one, e.g. after its participant was replaced.
  void restore(const Checkpoint& checkpoint);
  /// Puts another participant, in state instantiated, in the place of the present one, which is
  /// left as it is (its process may be dead). Follow with restore().
  void replaceParticipant(Participant& fresh);

 private:
  void processEvent();

  Participant* participant_;
  SteppedController& controller_;
  const EventCalendar& calendar_;
  Recorder* recorder_;
  MasterOptions options_;
  Observer observer_;
  SimTime time_{};
  std::int64_t tick_ = 0;
  ControlOutput control_;
  bool initialized_ = false;
  std::optional<End> ended_;
};

}  // namespace ballbot
