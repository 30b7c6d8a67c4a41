#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ballbot {

/// "A[2,3]" as "A" and "2,3"; nothing if the name does not end in brackets.
std::optional<std::pair<std::string, std::string>> splitElement(const std::string& name);

/// A whole number as people write one: digits without sign, blank or leading zero, below 2^31.
std::optional<std::size_t> wholeNumber(const std::string& text);

/// Place of an element in a row of values: "2,3" in an array of dimensions {3, 3} is 5, row by row.
/// One index counts through all of them. Nothing if that is no element.
/// @param first_index number of the first element: 1, or 0 in FMUs that count so
std::optional<std::size_t> elementOffset(const std::string& indices,
                                         const std::vector<std::size_t>& dimensions,
                                         std::size_t first_index = 1);

}  // namespace ballbot
