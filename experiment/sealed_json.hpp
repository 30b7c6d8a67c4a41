#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace ballbot {

/// Writes an object as a JSON file that knows whether it is as it was written: its last key,
/// `file_digest`, is the digest of all before it. @throw OutputError
void writeSealedJson(const std::string& path, nlohmann::ordered_json object);

/// Reads it back, without that key.
/// @throw InputError if it is not there, is no such file, or is damaged or edited
nlohmann::ordered_json readSealedJson(const std::string& path);

}  // namespace ballbot
