#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "cosim/schedule.hpp"
#include "model/added_signals.hpp"
#include "model/plan_timing.hpp"
#include "model/reports.hpp"
#include "model/self_assessment.hpp"
#include "model/signals.hpp"

namespace ballbot {

/// What a controller hands back at one event.
struct ControlOutput {
  ActuatorCommand command;  ///< acts from now on; keeps its value until it is changed
  // For the record only. The master clears the flags before each call.
  bool has_estimate = false;
  EstimateFrame estimate;
  bool has_plan = false;
  PlanFrame plan;
  // For those who judge the run; in no log.
  bool has_self_assessment = false;
  SelfAssessment self_assessment;
  PlanTiming plan_timing;  ///< of `plan`, where there is a wall clock
};

/// What a StepMaster steps a participant with. There is no way in here for a TruthFrame: the
/// master hands that from the participant to the recorder, past the controller.
class SteppedController {
 public:
  virtual ~SteppedController() = default;

  virtual std::string name() const { return "controller"; }

  /// Before onSensors(), where sensors were added to those of the frame.
  virtual void takeAddedSensors(const AddedSignals& sensors) noexcept { (void)sensors; }

  /// Called at every event of the calendar, in order: with the sensor values of `now`, before the
  /// participant advances. `due` has the tasks of the calendar that are due.
  virtual void onSensors(SimTime now, const SensorFrame& sensors, DueTasks due,
                         ControlOutput& out) noexcept = 0;

  /// What it adds to the record of an estimate or a plan; the list from the beginning on.
  virtual const AddedSignals& added(AddedTo) const { return AddedSignals::none(); }

  /// Everything that later output depends on.
  virtual StateBlob saveState() const = 0;
  virtual void restoreState(const StateBlob& blob) = 0;
  /// The same from a controller of other settings: what is known of the robot stays, and the first
  /// plan is made at the next event and acts at once.
  /// @throw InputError if the state is of too different a controller.
  virtual void takeOver(const StateBlob&) {
    throw InputError(name() + " cannot go on from the state of a controller of other settings");
  }

  /// What it has counted over the run, by names of metrics; and all names there can be.
  virtual std::map<std::string, double> metrics() const { return {}; }
  virtual std::vector<std::string> metricNames() const { return {}; }

  /// Has its plans timed.
  virtual void setWallClock(std::int64_t (*now_ns)() noexcept) { (void)now_ns; }
};

}  // namespace ballbot
