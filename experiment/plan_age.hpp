#pragma once

#include "experiment/scenario.hpp"

namespace ballbot {

/// Refuses rates at which plans are too old to act before the next ones take over: an LQR would
/// stand in for the MPC part of the time, or always, in the middle of good plans.
/// @throw InputError with file, line and column.
void requireYoungPlans(const Scenario& scenario);

}  // namespace ballbot
