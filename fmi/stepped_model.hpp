#pragma once

#include <cstdint>
#include <vector>

#include "cosim/stepped.hpp"

namespace ballbot {

/// A model in a coupling: a row of inputs, a row of outputs. What the rows hold, a CouplingNode
/// says.
class SteppedModel : public Stepped {
 public:
  /// Sets the inputs at the time it stands at, and takes the outputs that follow from them at once.
  virtual void evaluate(const std::vector<double>& inputs) = 0;
  /// Advances with the inputs held.
  virtual void doStep(SimTime now, SimDuration step, const std::vector<double>& inputs) = 0;

  virtual const std::vector<double>& outputs() const = 0;
  /// Hash of the complete state, or of the outputs where nobody knows more.
  virtual std::uint64_t stateDigest() const = 0;
};

}  // namespace ballbot
