#pragma once

#include <string>
#include <vector>

#include "hil/bench_config.hpp"

namespace ballbot {

/// Whether everything that the set-up of a bench writes, reads and maps is what the data sheets of
/// its drives and its IMU promise: objects, types, access, limits, mapping, bit rate. No bus is
/// touched.
/// @return every disagreement in words: where, what the bench file wants, what the sheet says in
///         which line, what to do
std::vector<std::string> checkDataSheets(const BenchConfig& config);

/// @throw InputError with all of them.
void requireDataSheets(const BenchConfig& config);

}  // namespace ballbot
