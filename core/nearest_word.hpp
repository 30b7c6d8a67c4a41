#pragma once

#include <set>
#include <string>

namespace ballbot {

/// The candidate that someone who wrote `word` most likely meant: nearest by edits, where a shared
/// beginning counts for more, because people leave the unit off. Empty if none is near.
std::string nearestWord(const std::string& word, const std::set<std::string>& candidates);

}  // namespace ballbot
