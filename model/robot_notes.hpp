#pragma once

#include <string>
#include <vector>

namespace ballbot {

class ConfigNode;

/// What the URDF of a `robot:` section has that is allowed and most likely not meant, a sentence
/// each, for whoever starts a run.
/// @throw InputError for a URDF that cannot be read
std::vector<std::string> robotNotes(const ConfigNode& robot);

}  // namespace ballbot
