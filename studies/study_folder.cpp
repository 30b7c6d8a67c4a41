#include "studies/study_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "experiment/build_info.hpp"
#include "experiment/run_folder.hpp"
#include "experiment/scenario_variants.hpp"
#include "experiment/text_file.hpp"
#include "report/json_text.hpp"
#include "studies/result_log.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Tasks of a killed study hold its lock until they are dead, too.
constexpr int kLockTries = 40;
constexpr int kLockPause_us = 50'000;

/// What decides the results: the study but for its words and patience, and the scenario.
std::string studyDigest(const Study& study, const Scenario& scenario) {
  ConfigNode tree = study.tree;
  for (const char* key : {"summary", "scenario", "report", "timeout_s"}) tree.erase(key);
  Digest digest;
  digest.add(toYaml(tree));
  digest.add(scenario.configDigest());
  return digest.hex();
}

Json manifest(const Study& study, const Scenario& scenario) {
  Json m;
  m["study"] = study.name;
  m["scenario"] = scenario.name;
  m["study_digest"] = studyDigest(study, scenario);
  for (const auto& [key, value] : buildInfo()) m["build"][key] = value;
  return m;
}

int lockFolder(const std::string& path) {
  const int file = ::open((path + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) throw OutputError(path + ": its file 'lock' cannot be opened");
  for (int i = 0; i < kLockTries; ++i) {
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
    ::usleep(kLockPause_us);
  }
  ::close(file);
  throw InputError(path + ": another process works on this study; wait for it, or end it first");
}

std::string newestFolder(const std::string& name) {
  std::vector<std::string> found;
  if (fs::is_directory("runs")) {
    for (const auto& entry : fs::directory_iterator("runs")) {
      const std::string folder = entry.path().filename().string();
      if (folder.rfind(name + "-", 0) == 0 && fs::exists(entry.path() / "study.yaml"))
        found.push_back(entry.path().string());
    }
  }
  if (found.empty()) {
    throw InputError(fmt::format(
        "--resume: there is no runs/{}-NNN to go on with; give its folder with --out", name));
  }
  return *std::max_element(found.begin(), found.end());
}

std::vector<std::string> resultFiles(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

StudyFolder::~StudyFolder() {
  if (lock_ >= 0) ::close(lock_);
}

StudyFolder StudyFolder::create(const std::string& wanted, const Study& study,
                                const ConfigNode& scenario_tree) {
  const Scenario scenario = readScenario(scenario_tree);
  const std::string path = RunFolder::create(wanted, study.name).path();
  StudyFolder folder(path, lockFolder(path));
  fs::create_directories(folder.resultsFolder());
  writeScenario(scenario, path);
  ConfigNode tree = study.tree;
  tree.set("scenario", ConfigNode::scalar("scenario.yaml", false, {}));
  writeTextFile(path + "/study.yaml", toYaml(tree));
  writeTextFile(path + "/manifest.json", jsonText(manifest(study, scenario)) + "\n");
  return folder;
}

StudyFolder StudyFolder::resume(const std::string& wanted, const Study& study,
                                const ConfigNode& scenario_tree) {
  const std::string path = wanted.empty() ? newestFolder(study.name) : wanted;
  if (!fs::exists(path + "/manifest.json") || !fs::is_directory(path + "/results")) {
    throw InputError(path + ": not the folder of a study; nothing to resume");
  }
  const Json now = manifest(study, readScenario(scenario_tree));
  const auto then = Json::parse(readTextFile(path + "/manifest.json"), nullptr, false);
  for (const char* key : {"study_digest", "build"}) {
    if (!then.is_object() || then.value(key, Json()) != now.at(key)) {
      throw InputError(fmt::format(
          "{}: was begun with another {}; its results would not fit together with new ones. "
          "Begin again in another folder",
          path, std::string(key) == "build" ? "version of the program" : "study or scenario"));
    }
  }
  return StudyFolder(path, lockFolder(path));
}

void StudyFolder::dropFailures() const {
  const auto kept = results();
  const std::vector<std::string> old = resultFiles(resultsFolder());
  const std::string half = path_ + "/results.part";
  fs::remove(half);
  {
    ResultLog log(half);
    for (const auto& [id, result] : kept) {
      if (ran(result.outcome)) log.append(result.toJson());
    }
  }
  // Between these steps a case may stand in two files, with the same result; none is in no file.
  const std::string name = resultsFolder() + "/kept.jsonl";
  fs::rename(half, name);
  for (const std::string& file : old) {
    if (file != name) fs::remove(file);
  }
}

std::map<std::string, CaseResult> StudyFolder::results() const {
  std::map<std::string, CaseResult> out;
  for (const std::string& name : resultFiles(resultsFolder())) {
    for (const std::string& record : readResultLog(name).records) {
      CaseResult result = CaseResult::fromJson(record);
      out[result.id] = std::move(result);
    }
  }
  return out;
}

}  // namespace ballbot
