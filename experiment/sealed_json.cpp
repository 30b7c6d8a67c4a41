#include "experiment/sealed_json.hpp"

#include <nlohmann/json.hpp>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "experiment/text_file.hpp"
#include "report/json_text.hpp"

namespace ballbot {
namespace {

constexpr const char* kSeal = "file_digest";
constexpr int kDeepest = 20;  // far more than any file of a run; writing recurses

nlohmann::ordered_json parsed(const std::string& path, const std::string& text) {
  const auto limitDepth = [&](int depth, nlohmann::ordered_json::parse_event_t,
                              const nlohmann::ordered_json&) {
    if (depth > kDeepest) throw InputError(path + ": is nested too deep for a file of a run");
    return true;
  };
  auto object = nlohmann::ordered_json::parse(text, limitDepth, false);
  if (object.is_object()) return object;
  throw InputError(path + ": is no JSON object; it is damaged or was edited");
}

std::string sealed(nlohmann::ordered_json& object) {
  Digest digest;
  digest.add(jsonText(object));
  object[kSeal] = digest.hex();
  return jsonText(object) + "\n";
}

}  // namespace

void writeSealedJson(const std::string& path, nlohmann::ordered_json object) {
  writeTextFile(path, sealed(object));
}

nlohmann::ordered_json readSealedJson(const std::string& path) {
  const std::string text = readTextFile(path);
  nlohmann::ordered_json object = parsed(path, text);
  if (object.erase(kSeal) == 0) {
    throw InputError(path + ": has no '" + kSeal +
                     "'; it was edited, or an older version wrote it");
  }
  // Byte for byte: other spaces, or a number written otherwise, are not what was written either.
  nlohmann::ordered_json again = object;
  if (sealed(again) == text) return object;
  throw InputError(path + ": is damaged or was edited: its content does not match its '" + kSeal +
                   "'");
}

}  // namespace ballbot
