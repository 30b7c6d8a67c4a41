#include "core/number_text.hpp"

#include <fmt/format.h>

namespace ballbot {

std::string numberText(double value) { return fmt::format("{}", value); }

}  // namespace ballbot
