#pragma once

#include <string>

#include "hil/bench.hpp"

namespace ballbot {

/// The cycles of a bench as a table: a line of names, then one for each.
std::string cycleCsvHeader();
std::string cycleCsvLine(const CycleRecord& record);

}  // namespace ballbot
