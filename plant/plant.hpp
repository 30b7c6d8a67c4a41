#pragma once

#include <memory>

#include "core/state_blob.hpp"
#include "model/external_forces.hpp"
#include "model/signals.hpp"
#include "model/truth.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {

/// The robot as simulated: rigid bodies, drives, sensors and what the world does to it. Equal
/// configuration and equal calls give equal bits, here and in another process. As long as the
/// calls' times are drive ticks, it makes no difference either how the way there is cut into calls.
class Plant {
 public:
  /// @throw InputError if the parameters are not those of a physical robot.
  explicit Plant(const PlantConfig& config);
  ~Plant();

  /// Puts the robot at its initial pose at time `start`: at rest, one IMU sample taken.
  void reset(SimTime start);

  SimTime now() const;

  /// Advances exactly to `t`, later than now(), while `command` is what the drives are sent. Time
  /// is cut at drive ticks, IMU samples, the ends of pushes and the release.
  /// @throw InputError if t is not later. NumericalError if the command is not finite (nothing has
  ///        changed then), or the state is not any more (restore or reset before going on).
  void advanceTo(SimTime t, const ActuatorCommand& command);

  /// Forces that act from now on, besides the scheduled ones, until they are set again. They are
  /// inputs like the command: no part of the saved state; reset() leaves them.
  /// @throw NumericalError if they are not finite.
  void setExternalForces(const ExternalForces& forces);

  const SensorFrame& sensors() const;
  const TruthFrame& truth() const;
  /// Beside the sensors' frame, as of the last tick of the drives; beside the truth, as of now.
  const AddedSignals& added(AddedTo frame) const;

  StateBlob saveState() const;
  /// @throw InputError if the blob is damaged or of a plant whose state has another form (other
  ///        fidelity or periods); the state is unchanged then.
  void restoreState(const StateBlob& blob);
  /// Hash of the complete state.
  std::uint64_t stateDigest() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ballbot
