#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace ballbot {

/// JSON as this program writes it. Names and paths may hold bytes that are no UTF-8, which JSON
/// cannot say: they become U+FFFD, where a plain dump() would throw.
/// @param indent -1 for one line
template <typename Json>
std::string jsonText(const Json& json, int indent = 2) {
  return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace ballbot
