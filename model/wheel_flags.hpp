#pragma once

#include <algorithm>
#include <array>

#include "model/state.hpp"

namespace ballbot {

/// Something about each wheel that is so or is not.
using WheelFlags = std::array<bool, kWheelCount>;

inline bool any(const WheelFlags& flags) noexcept {
  return std::any_of(flags.begin(), flags.end(), [](bool flag) { return flag; });
}

}  // namespace ballbot
