#pragma once

#include <cstdint>
#include <optional>

#include "core/time.hpp"
#include "cosim/stepped_controller.hpp"
#include "model/signals.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// All that happened at one event of a run; for the recorder and for whoever judges the run.
struct Tick {
  std::int64_t number;
  SimTime time;
  const SensorFrame& sensors;
  const std::optional<TruthFrame>& truth;
  const ControlOutput& control;
  std::uint64_t state_digest;               ///< of the participant's complete state
  PerAddedTo<const AddedSignals*> added{};  ///< null or empty: none
};

}  // namespace ballbot
