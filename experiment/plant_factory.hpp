#pragma once

#include <memory>

#include "cosim/participant.hpp"
#include "experiment/run_config.hpp"

namespace ballbot {

/// The plant of a run, in this process.
/// @throw InputError, LostParticipantError for FMUs that cannot be set up.
std::unique_ptr<Participant> makePlant(const PlantSetup& setup);

}  // namespace ballbot
