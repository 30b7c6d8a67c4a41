#pragma once

#include <string>
#include <vector>

#include "core/config_listing.hpp"

namespace ballbot {

/// Every key that a scenario may hold, by what each part of the program tells of its own
/// (describe() of the configuration structs), in the order of a scenario file.
const std::vector<KeyEntry>& scenarioKeys();

/// A key and, of a mapping, those below it; a number in the path stands for any item of a list.
/// @throw InputError if no scenario has such a key, naming the nearest.
std::vector<KeyEntry> keysAt(const std::string& path);

/// JSON Schema (draft 2020-12) of scenario files, with which editors complete and check. It demands
/// no key, since a file may take any from one that it includes.
std::string scenarioSchema();

}  // namespace ballbot
