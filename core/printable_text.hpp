#pragma once

#include <string>
#include <string_view>

namespace ballbot {

/// Text of a stranger (another process, a file, a bus) as it may go to a terminal: control
/// characters but the line end, and bytes that are no UTF-8, become '?'. So no escape sequence
/// moves the cursor, renames the window or types for the user.
std::string printableText(std::string_view text);

}  // namespace ballbot
