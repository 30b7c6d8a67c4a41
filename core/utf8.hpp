#pragma once

#include <cstddef>
#include <string>

namespace ballbot {

/// Length in bytes of the UTF-8 character at `at`, or 0 if there is none.
std::size_t utf8Length(const std::string& text, std::size_t at);

/// Whether the whole text is UTF-8.
bool isUtf8(const std::string& text);

/// ISO-8859-1, in which every byte is a character, as UTF-8.
std::string utf8FromLatin1(const std::string& text);

}  // namespace ballbot
