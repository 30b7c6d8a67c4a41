#pragma once

#include <string>
#include <vector>

#include "core/config_node.hpp"

namespace ballbot {

/// A value on one line, as YAML that reads back to the same tree: "[1, 2]", "{enabled: false}".
std::string toFlowYaml(const ConfigNode& value);

/// `word` as one word of a POSIX shell.
std::string shellQuoted(const std::string& word);
/// Words joined to a command line.
std::string commandLine(const std::vector<std::string>& words);

}  // namespace ballbot
