#pragma once

#include <optional>
#include <string>

#include "cosim/step_master.hpp"
#include "experiment/run_folder.hpp"

namespace ballbot {

/// Leaves a checkpoint among those of a run. @throw OutputError
void writeCheckpoint(const Checkpoint& checkpoint, const RunFolder& run);

/// The last one of a run at or before `time`; what a continued run began with counts.
/// @throw InputError if it is damaged.
std::optional<Checkpoint> lastCheckpoint(const RunFolder& run, SimTime time);

/// What a run begins with that continues another one. @throw OutputError
void writeStart(const Checkpoint& checkpoint, const RunFolder& run);
/// None if the run begins at its beginning. @throw InputError if it is damaged.
std::optional<Checkpoint> readStart(const RunFolder& run);

}  // namespace ballbot
