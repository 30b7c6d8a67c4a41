#pragma once

#include "experiment/key_book.hpp"

namespace ballbot {

/// Of a scenario: what each part of the program tells of its own (describe() of the configuration
/// structs).
const KeyBook& scenarioKeys();

}  // namespace ballbot
