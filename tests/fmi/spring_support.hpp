#pragma once

#include <string>

namespace ballbot {

/// The tests' own small FMU, written below the temporary folder once per process: a spring between
/// the hand and an anchor, a push, and trouble when asked for. See spring_fmu.xml.
const std::string& springFmu();

}  // namespace ballbot
