#pragma once

namespace ballbot {

/// A limit of this size or beyond, in whatever unit, means that there is none. Finite, so that a
/// distance to it and a cost of it are numbers.
constexpr double kUnlimited = 1e6;

}  // namespace ballbot
