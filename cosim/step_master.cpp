#include "cosim/step_master.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/state_visitors.hpp"
#include "model/signal_check.hpp"

namespace ballbot {
namespace {

constexpr const char* kBlobKind = "checkpoint";
constexpr std::uint32_t kBlobVersion = 1;

}  // namespace

StateBlob Checkpoint::toBlob() const { return saveStateOf(*this, kBlobKind, kBlobVersion); }

Checkpoint Checkpoint::fromBlob(const StateBlob& blob) {
  Checkpoint out;
  restoreStateOf(out, blob, kBlobKind, kBlobVersion);
  return out;
}

StepMaster::StepMaster(Participant& participant, SteppedController& controller,
                       const EventCalendar& calendar, Recorder* recorder, MasterOptions options)
    : participant_(&participant),
      controller_(controller),
      calendar_(calendar),
      recorder_(recorder),
      options_(options),
      time_(options.start) {
  if (options.end <= options.start) {
    throw InputError(fmt::format("the run ends at {}, before it begins at {}", toText(options.end),
                                 toText(options.start)));
  }
}

StepMaster::End StepMaster::run() {
  if (!initialized_) initialize();
  while (step()) {
  }
  terminate();
  return *ended_;
}

void StepMaster::initialize() {
  participant_->initialize(options_.start);
  initialized_ = true;
}

bool StepMaster::step() {
  if (options_.stop != nullptr && options_.stop->load()) {
    throw InterruptedError(fmt::format("stopped at {} of {}", toText(time_), toText(options_.end)));
  }
  processEvent();
  if (ended_) return false;
  const SimTime next = std::min(calendar_.nextAfter(time_), options_.end);
  participant_->doStep(time_, next - time_, control_.command);
  time_ = next;
  ++tick_;
  return true;
}

void StepMaster::processEvent() {
  control_.has_estimate = control_.has_plan = control_.has_self_assessment = false;
  const AddedSignals& sensors = participant_->added(AddedTo::kSensors);
  if (!sensors.empty()) controller_.takeAddedSensors(sensors);
  controller_.onSensors(time_, participant_->sensors(), calendar_.dueAt(time_), control_);
  const std::string bad = firstNonFinite(control_.command);
  if (!bad.empty()) {
    throw LostParticipantError(
        controller_.name(),
        fmt::format("{}: command at {}: {}", controller_.name(), toText(time_), bad));
  }
  const std::optional<TruthFrame> truth = participant_->truth();
  const Tick tick{tick_,
                  time_,
                  participant_->sensors(),
                  truth,
                  control_,
                  participant_->stateDigest(),
                  {{&sensors, &participant_->added(AddedTo::kTruth),
                    &controller_.added(AddedTo::kEstimate), &controller_.added(AddedTo::kPlan)}}};
  if (recorder_ != nullptr) recorder_->record(tick);
  if (observer_ && !observer_(tick)) {
    ended_ = End::kObserver;
  } else if (time_ >= options_.end) {
    ended_ = End::kDuration;
  }
}

void StepMaster::terminate() { participant_->terminate(); }

Checkpoint StepMaster::save() const {
  return {time_, tick_, control_.command, participant_->saveState(), controller_.saveState()};
}

void StepMaster::restore(const Checkpoint& checkpoint) {
  if (!initialized_) initialize();
  participant_->restoreState(checkpoint.participant);
  controller_.restoreState(checkpoint.controller);
  control_.command = checkpoint.command;
  time_ = checkpoint.time;
  tick_ = checkpoint.tick;
  ended_.reset();
}

void StepMaster::replaceParticipant(Participant& fresh) {
  participant_ = &fresh;
  initialized_ = false;
}

}  // namespace ballbot
