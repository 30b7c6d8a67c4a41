#pragma once

#include <cstdint>
#include <optional>

#include "cosim/stepped.hpp"
#include "model/added_signals.hpp"
#include "model/signals.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// What stands at the far end of the step protocol: the plant, real drives, or an FMU. Typed frames
/// go in and out. cosim/lifecycle.hpp enforces the order of calls, so an implementation may rely on
/// it. saveState and restoreState may be called in any state but instantiated.
class Participant : public Stepped {
 public:
  /// Advances from `now` exactly to `now + step` with the command held.
  /// @throw NumericalError if the result is not finite.
  virtual void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) = 0;

  /// Sensor values at the current time.
  virtual const SensorFrame& sensors() const = 0;
  /// True state at the current time, for the record; nothing where nobody knows it (real drives).
  virtual std::optional<TruthFrame> truth() const = 0;

  /// Values beside those of its sensor or truth frame, at the current time; the list from the
  /// beginning on. Those of the truth are there whenever truth() is.
  virtual const AddedSignals& added(AddedTo) const { return AddedSignals::none(); }

  /// Hash of the complete state, cheap enough for every step.
  virtual std::uint64_t stateDigest() const = 0;
};

}  // namespace ballbot
