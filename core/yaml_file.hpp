#pragma once

#include <string>

#include "core/config_node.hpp"

namespace ballbot {

/// Reads a YAML file into a tree. A mapping with the key `include` starts from the file named
/// there (relative to the including file) and lays its other keys on top, at any depth.
/// @throw InputError file missing or not YAML, duplicate key, anchor or tag, include cycle; the
///        text names file, line and column.
ConfigNode loadYamlFile(const std::string& path);

/// Reads YAML text. `source` is the name that errors give, e.g. "--set plant.seed=3".
/// @throw InputError as loadYamlFile; `include` is not followed.
ConfigNode parseYaml(const std::string& text, const std::string& source);

/// Applies one "path=value" override as given to --set; the value is YAML.
/// @throw InputError if there is no '=' or the value is not YAML.
void applyOverride(ConfigNode& root, const std::string& path_equals_value);

}  // namespace ballbot
