#pragma once

#include "model/state.hpp"

namespace ballbot {

/// The rotation nearest to R, for an R that is off by rounding only.
Matrix3 orthonormalized(const Matrix3& R) noexcept;

/// Follows yaw across +-180 degrees: the value congruent to `wrapped` nearest to `previous` [rad].
double unwrapped(double wrapped, double previous) noexcept;

}  // namespace ballbot
