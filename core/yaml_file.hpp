#pragma once

#include <string>
#include <utility>

#include "core/config_node.hpp"

namespace ballbot {

/// Reads a YAML file into a tree. A mapping with the key `include` starts from the file named
/// there (relative to the including file) and lays its other keys on top, at any depth; a key laid
/// on top whose value is null drops what was included. Of YAML only what says one thing in one
/// place is read.
/// @throw InputError file missing or not YAML, a second document, duplicate key, anchor, alias,
/// tag,
///        merge key, include cycle; the text names file, line and column.
ConfigNode loadYamlFile(const std::string& path);

/// Reads YAML text. `source` is the name that errors give, e.g. "--set plant.seed=3".
/// @throw InputError as loadYamlFile; `include` is not followed.
ConfigNode parseYaml(const std::string& text, const std::string& source);

/// Reads one "path=value" as given to --set; the value is YAML, includes in it are followed,
/// relative to the working folder.
/// @throw InputError if there is no '=', the value is not YAML, or the path ends with `include`.
std::pair<std::string, ConfigNode> readOverride(const std::string& path_equals_value);

/// Reads it and sets it in a tree; the value null drops what is there.
void applyOverride(ConfigNode& root, const std::string& path_equals_value);

}  // namespace ballbot
