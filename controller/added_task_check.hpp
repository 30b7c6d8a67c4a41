#pragma once

#include <string>

#include "controller/tasks.hpp"

namespace ballbot {

/// @param where  the task stands, for words about it
/// @throw InputError if the task's residual, or its derivative, is not finite with the robot at
/// rest, by weight and reference at the start.
void requireFinite(const AddedTask& task, const StateVector& rest, const std::string& where);

/// Says of a plan that was refused because something is not finite which tasks are not: their terms
/// become NaN, others keep what they are. Free of allocation.
void markNotFinite(const TaskSchedule& schedule, double now, const StateVector& x,
                   CostTerms& terms) noexcept;

}  // namespace ballbot
