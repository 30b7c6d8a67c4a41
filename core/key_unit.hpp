#pragma once

#include <string>

namespace ballbot {

/// The unit that the name of a key or metric ends in, as people write it: "N m/rad" for
/// spring_stiffness_Nm_per_rad, "m/s^2" for gravity_m_per_s2. Empty where there is none.
std::string unitOfKey(const std::string& name);

}  // namespace ballbot
