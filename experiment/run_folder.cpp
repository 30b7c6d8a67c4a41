#include "experiment/run_folder.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {

namespace fs = std::filesystem;

RunFolder RunFolder::create(const std::string& wanted, const std::string& scenario_name) {
  std::error_code failed;
  if (!wanted.empty()) {
    if (fs::exists(wanted) && (!fs::is_directory(wanted) || !fs::is_empty(wanted))) {
      throw InputError(
          fmt::format("{}: exists already and is not an empty folder. Nothing was "
                      "overwritten; give another --out, or remove it",
                      wanted));
    }
    fs::create_directories(wanted, failed);
    if (failed)
      throw OutputError(fmt::format("{}: cannot be created: {}", wanted, failed.message()));
    return RunFolder(wanted);
  }
  fs::create_directories("runs", failed);
  if (failed) throw OutputError(fmt::format("runs: cannot be created: {}", failed.message()));
  // create_directory is false, without an error, where the folder exists: so two runs started at
  // once get two numbers.
  for (int i = 1; i < 1'000'000; ++i) {
    const std::string path = fmt::format("runs/{}-{:03}", scenario_name, i);
    if (fs::create_directory(path, failed)) return RunFolder(path);
    if (failed) throw OutputError(fmt::format("{}: cannot be created: {}", path, failed.message()));
  }
  throw OutputError("runs: a million runs are enough; remove some or give --out");
}

RunFolder RunFolder::open(const std::string& path) {
  const RunFolder folder(path);
  if (!fs::is_directory(path)) {
    throw InputError(
        fmt::format("{}: no such folder; give the folder of a run, e.g. runs/balance-001", path));
  }
  if (!fs::exists(folder.manifestFile()) || !fs::exists(folder.scenarioFile())) {
    throw InputError(fmt::format(
        "{}: not the folder of a run: manifest.json or scenario.yaml is missing", path));
  }
  return folder;
}

void RunFolder::discardUnlessRecorded() const {
  std::error_code unknown;
  if (fs::exists(logFile(), unknown) && fs::file_size(logFile(), unknown) > 0) return;
  fs::remove_all(path_, unknown);
}

}  // namespace ballbot
