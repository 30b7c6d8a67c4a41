#pragma once

#include <string>

namespace ballbot {

/// A text as it may stand between tags of HTML, XML and SVG.
std::string markupEscaped(const std::string& text);

}  // namespace ballbot
