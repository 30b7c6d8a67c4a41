#pragma once

#include <vector>

#include "core/error.hpp"
#include "hil/rehearsal/fault_table.hpp"

namespace ballbot {

/// Prints what was tried; kRequirementMissed if a row did not hold.
ExitCode showRows(const std::vector<FaultRow>& rows, bool json);

/// Prints every check of the bench: name, words, reaction, bound, page.
ExitCode showChecks(bool json);

}  // namespace ballbot
