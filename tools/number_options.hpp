#pragma once

#include <CLI/CLI.hpp>

namespace ballbot {

/// Has every option of the program whose value is a number read it as configuration files do:
/// decimal ("012" is twelve), whole where a whole number is asked for, finite, not empty. To be
/// called once all verbs are there; ranges stay where the options are.
void readNumbersAsFilesDo(CLI::App& program);

}  // namespace ballbot
