#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ballbot {

// How numbers are written and read wherever a person or a file gives them: decimal, with a point,
// in no locale.

/// The shortest decimal text that reads back to the same bits.
std::string numberText(double value);

/// The number that the whole of `text` is: one sign at most, digits, a point, an exponent; or inf
/// or nan, which the caller refuses in words of its own. "012" is twelve; "0x10", "1,5" and "" are
/// none.
std::optional<double> parseNumber(std::string_view text);

/// The same where it is whole and so small that every whole number up to it has a double: "7",
/// "1e3".
std::optional<std::int64_t> parseWhole(std::string_view text);
constexpr double kLargestWhole = 9007199254740992.0;  // 2^53

/// Seconds as people write them: 7 500 000 ns are 0.0075, and not the neighbour of it that
/// toSeconds() gives, whose rounding the results of runs rest on.
double decimalSeconds(std::int64_t ns);

}  // namespace ballbot
