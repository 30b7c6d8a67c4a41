#pragma once

#include <cstdint>
#include <vector>

#include "core/state_blob.hpp"
#include "core/time.hpp"

namespace ballbot {

/// A model in a coupling, seen from outside: a row of inputs, a row of outputs, steps. What the
/// rows hold, a CouplingNode says.
class SteppedModel {
 public:
  virtual ~SteppedModel() = default;

  virtual void initialize(SimTime start) = 0;
  /// Sets the inputs at the time it stands at, and takes the outputs that follow from them at once.
  virtual void evaluate(const std::vector<double>& inputs) = 0;
  /// Advances with the inputs held.
  virtual void step(SimTime now, SimDuration step, const std::vector<double>& inputs) = 0;
  virtual void terminate() = 0;
  virtual void reset() = 0;
  /// @throw InputError if it cannot.
  virtual StateBlob save() = 0;
  virtual void restore(const StateBlob& blob) = 0;

  virtual const std::vector<double>& outputs() const = 0;
  /// Hash of the complete state, or of the outputs where nobody knows more.
  virtual std::uint64_t digest() const = 0;
};

}  // namespace ballbot
