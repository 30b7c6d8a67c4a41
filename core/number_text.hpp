#pragma once

#include <string>

namespace ballbot {

/// The shortest decimal text that reads back to the same bits, in no locale.
std::string numberText(double value);

}  // namespace ballbot
