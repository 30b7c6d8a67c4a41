#pragma once

#include <string>

#include "core/state_blob.hpp"
#include "core/time.hpp"

namespace ballbot {

/// Whatever is stepped through time: participants of a run, models of a coupling, FMUs. All live
/// the life of FMI 3.0 Co-Simulation, under its names; cosim/lifecycle_state.hpp has the states,
/// and which call is allowed in which:
///
///   instantiated --enterInitializationMode--> initialization --exitInitializationMode--> step
///   step --doStep*--> step --terminate--> terminated; any state --reset--> instantiated
///
/// What goes in and comes out at a step each kind says of itself, and so doStep() is each kind's.
class Stepped {
 public:
  virtual ~Stepped() = default;

  virtual std::string name() const = 0;

  /// Prepares the state at `start`. @throw Error if that cannot be done.
  virtual void enterInitializationMode(SimTime start) = 0;
  /// After this, what comes out is valid for `start`.
  virtual void exitInitializationMode() = 0;
  void initialize(SimTime start) {
    enterInitializationMode(start);
    exitInitializationMode();
  }

  virtual void terminate() = 0;
  virtual void reset() = 0;

  /// The complete state; restoring it, here or in another process, continues bit for bit.
  /// @throw InputError from what cannot.
  virtual StateBlob saveState() const = 0;
  /// Also leads back into the state of life that was saved. @throw InputError if the blob is
  /// damaged or of another configuration; the state is unchanged.
  virtual void restoreState(const StateBlob& blob) = 0;
};

}  // namespace ballbot
