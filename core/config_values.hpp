#pragma once

#include <cstdint>
#include <string>

#include "core/config_reader.hpp"

namespace ballbot {

class ConfigVisitor;

// Values of a kind that few keys have. @throw InputError as ConfigReader.

/// A whole number too large for an int, such as a seed: up to kLargestWhole to either side.
std::int64_t readWhole(ConfigReader& in, const std::string& key, Range range = {});

/// Text that can name a file or a folder, and no path that leads elsewhere.
std::string readFileName(ConfigReader& in, const std::string& key);

/// The key `seed` of a scenario, for all who read it.
void describeSeed(ConfigVisitor& v, std::uint64_t& seed);

}  // namespace ballbot
