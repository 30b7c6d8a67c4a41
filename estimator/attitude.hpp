#pragma once

#include "model/state.hpp"

namespace ballbot {

/// The rotation nearest to R, for an R that is off by rounding only.
Matrix3 orthonormalized(const Matrix3& R) noexcept;

/// Inverse of the right Jacobian of SO(3): log(exp(phi) exp(d)) = phi + J d to first order in d.
/// Its transpose is the inverse left Jacobian. For |phi| < pi [rad].
Matrix3 inverseRightJacobian(const Vector3& phi) noexcept;

/// Follows yaw across +-180 degrees: the value congruent to `wrapped` nearest to `previous` [rad].
double unwrapped(double wrapped, double previous) noexcept;

}  // namespace ballbot
