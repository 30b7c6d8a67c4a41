#pragma once

#include <string>
#include <vector>

#include "model/added_signals.hpp"

namespace ballbot {

/// Names of what is added to the frames of a recorded table: lower-case letters, digits and _, each
/// once, and none that the table has already.
/// @param table  "sensors" or "plan"
/// @throw InputError saying which name is wrong, and why.
void requireNewNames(const std::vector<AddedSignal>& added, const std::string& table);

}  // namespace ballbot
