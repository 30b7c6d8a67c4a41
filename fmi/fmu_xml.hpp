#pragma once

#include <string>

#include "fmi/fmu_description.hpp"

namespace ballbot {

/// What a modelDescription.xml says; its names are not looked at yet. Text that is no UTF-8 is
/// taken for ISO-8859-1. Time and memory grow with the length of the text and no faster.
/// @param file the FMU's, for messages
/// @throw InputError
FmuDescription parseFmuDescription(const std::string& xml, const std::string& file);

}  // namespace ballbot
