#pragma once

#include <string>

namespace ballbot {

class ConfigNode;

/// A key or a bare text as YAML reads it back: bare where it can be, else quoted. For whoever
/// writes YAML, in whatever layout.
std::string yamlText(const std::string& text);
/// A scalar; one that was quoted stays so, because "1" is no number.
std::string yamlText(const ConfigNode& scalar);

}  // namespace ballbot
