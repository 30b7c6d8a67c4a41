#pragma once

#include <string>

#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "cosim/schedule.hpp"
#include "model/reports.hpp"
#include "model/signals.hpp"

namespace ballbot {

/// What a controller hands back at one event.
struct ControlOutput {
  ActuatorCommand command;  ///< acts from now on; keeps its value until it is changed
  // For the record only. The master clears both flags before each call.
  bool has_estimate = false;
  EstimateFrame estimate;
  bool has_plan = false;
  PlanFrame plan;
};

/// What a StepMaster steps a participant with. There is no way in here for a TruthFrame: the
/// master hands that from the participant to the recorder, past the controller.
class SteppedController {
 public:
  virtual ~SteppedController() = default;

  virtual std::string name() const { return "controller"; }

  /// Called at every event of the calendar, in order: with the sensor values of `now`, before the
  /// participant advances. `due` has the tasks of the calendar that are due.
  virtual void onSensors(SimTime now, const SensorFrame& sensors, DueTasks due,
                         ControlOutput& out) noexcept = 0;

  /// Everything that later output depends on.
  virtual StateBlob saveState() const = 0;
  virtual void restoreState(const StateBlob& blob) = 0;
};

}  // namespace ballbot
