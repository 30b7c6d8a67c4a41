#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/state_blob.hpp"
#include "core/time.hpp"
#include "model/added_signals.hpp"
#include "model/signals.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// What stands at the far end of the step protocol: the plant, real drives, or an FMU. Names and
/// call order are those of FMI 3.0 Co-Simulation; cosim/lifecycle.hpp enforces the order, so an
/// implementation may rely on it:
///
///   instantiated --enterInitializationMode--> initialization --exitInitializationMode--> step
///   step --doStep*--> step --terminate--> terminated; any state --reset--> instantiated
///
/// saveState and restoreState may be called in any state but instantiated; restoreState also leads
/// back into the state that was saved.
class Participant {
 public:
  virtual ~Participant() = default;

  virtual std::string name() const = 0;

  /// Prepares the state at `start`. @throw Error if that cannot be done.
  virtual void enterInitializationMode(SimTime start) = 0;
  /// After this, sensors() and truth() are valid for `start`.
  virtual void exitInitializationMode() = 0;

  /// Advances from `now` exactly to `now + step` with the command held.
  /// @throw NumericalError if the result is not finite.
  virtual void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) = 0;

  virtual void terminate() = 0;
  virtual void reset() = 0;

  /// Sensor values at the current time.
  virtual const SensorFrame& sensors() const = 0;
  /// True state at the current time, for the record; nothing where nobody knows it (real drives).
  virtual std::optional<TruthFrame> truth() const = 0;

  /// Values beside those of its sensor or truth frame, at the current time; the list from the
  /// beginning on. Those of the truth are there whenever truth() is.
  virtual const AddedSignals& added(AddedTo) const { return AddedSignals::none(); }

  /// The complete state; restoring it, here or in another process, continues bit for bit.
  virtual StateBlob saveState() const = 0;
  /// @throw InputError if the blob is damaged or of another configuration; the state is unchanged.
  virtual void restoreState(const StateBlob& blob) = 0;

  /// Hash of the complete state, cheap enough for every step.
  virtual std::uint64_t stateDigest() const = 0;
};

}  // namespace ballbot
