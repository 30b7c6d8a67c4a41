#include "experiment/recorded_run.hpp"

#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "cosim/event_log.hpp"
#include "experiment/build_info.hpp"
#include "experiment/scenario.hpp"
#include "experiment/sealed_json.hpp"
#include "experiment/text_file.hpp"

namespace ballbot {
namespace {

using Json = nlohmann::ordered_json;

// Of a summary, what was asked of the run, or how it was kept, and not what happened in it.
constexpr const char* kNotFacts[] = {"scenario", "passed", "requirements", "log_digest"};

/// Reads members of a sealed file; a wrong type is said with the file's name.
template <typename Read>
void readMembers(const std::string& path, Read&& read) {
  try {
    read(readSealedJson(path));
  } catch (const nlohmann::json::exception& e) {
    throw InputError(fmt::format("{}: is not what a run writes: {}", path, e.what()));
  }
}

/// Damage that the events themselves do not show: the bytes are not those that were written.
std::string otherBytes(const RunFolder& run, const RunLog& log) {
  const auto summary = readSummary(run);
  if (!summary) return "";
  if (log.cut_off) return "it ends in the middle of an event, and the run did not";
  if (logDigest(run.logFile()) == summary->log_digest) return "";
  return "its bytes are not those that summary.json says, though every event reads well; parts of "
         "it "
         "are missing or were edited";
}

}  // namespace

RecordedManifest readManifest(const RunFolder& run) {
  RecordedManifest out;
  readMembers(run.manifestFile(), [&](const Json& m) {
    out.config_digest = m.at("config_digest");
    if (m.contains("begins_at_s")) out.begins_at_s = m.at("begins_at_s").get<double>();
    out.build = m.at("build").get<std::map<std::string, std::string>>();
  });
  return out;
}

std::optional<RecordedSummary> readSummary(const RunFolder& run) {
  if (!std::filesystem::exists(run.summaryFile())) return std::nullopt;
  RecordedSummary out;
  out.text = readTextFile(run.summaryFile());
  readMembers(run.summaryFile(), [&](const Json& s) {
    out.simulated_s = s.at("simulated_s");
    out.log_digest = s.at("log_digest");
    for (const auto& [name, value] : s.at("metrics").items()) {
      out.metrics[name] =
          value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
    }
    for (const auto& [name, value] : s.items()) out.facts[name] = value.dump();
    for (const char* name : kNotFacts) out.facts.erase(name);
  });
  return out;
}

std::string buildDifference(const RecordedManifest& manifest) {
  std::string out;
  for (const auto& [key, now] : buildInfo()) {
    const auto it = manifest.build.find(key);
    const std::string then = it == manifest.build.end() ? "unknown" : it->second;
    if (then != now)
      out += fmt::format("{}{} was {}, is {}", out.empty() ? "" : "; ", key, then, now);
  }
  return out;
}

void requireUnedited(const RunFolder& run) {
  const RecordedManifest manifest = readManifest(run);
  const std::string now = loadScenario(run.scenarioFile()).configDigest();
  if (now == manifest.config_digest) return;
  const std::string build = buildDifference(manifest);
  throw InputError(fmt::format(
      "{}: scenario.yaml, robot.urdf or an FMU in it is not what was run: config_digest is {}, "
      "manifest.json says {}. To run it changed: ballbot run {}{}",
      run.path(), now, manifest.config_digest, run.scenarioFile(),
      build.empty() ? "" : "\nThis is another build: " + build));
}

void requireWholeLog(const RunFolder& run) {
  const RunLog log = readRecordedLog(run);
  if (!log.damage.none()) {
    throw InputError(fmt::format("{}: {}", run.logFile(), log.damage.text()));
  }
}

RunLog readRecordedLog(const RunFolder& run) {
  RunLog log = readRunLog(run.logFile());
  if (!log.damage.none()) return log;
  const std::string what = otherBytes(run, log);
  if (!what.empty()) {
    const auto size = std::filesystem::file_size(run.logFile());
    log.damage.add(log.cut_off ? static_cast<std::int64_t>(size) : 0, what);
  }
  return log;
}

}  // namespace ballbot
