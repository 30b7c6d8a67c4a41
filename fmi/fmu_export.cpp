#include "fmi/fmu_export.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "core/markup_text.hpp"
#include "fmi/model_description.hpp"
#include "fmi/plant_contents.hpp"
#include "fmi/plant_fmu.hpp"
#include "fmi/zip_archive.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

std::string readFile(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string() + ": cannot be read");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder)) {
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The sections that the plant is made from, with the URDF beside them.
ConfigNode plantScenario(const ConfigNode& scenario) {
  ConfigNode out = ConfigNode::map({});
  const auto take = [&](const char* key) {
    if (const ConfigNode* node = scenario.find(key)) out.set(key, *node);
  };
  for (const char* key : {"name", "summary", "duration_s"}) take(key);
  for (const char* section : kPlantSections) take(section);
  if (scenario.find("fmus")) {
    throw InputError(
        "the scenario has FMUs of its own (section 'fmus'), which an export cannot "
        "hold; take them out, and couple them where the export is imported");
  }
  ConfigNode* robot = out.find("robot");
  if (!robot) throw InputError("the scenario has no section 'robot'");
  robot->set("urdf", ConfigNode::scalar("robot.urdf", false, {}));
  return out;
}

std::string documentation(const FmuVariables& variables, const ModelFacts& facts) {
  std::string rows;
  for (const FmuVariable& v : variables.all()) {
    const char* role = v.role == VariableRole::kInput       ? "input"
                       : v.role == VariableRole::kOutput    ? "output"
                       : v.role == VariableRole::kParameter ? "parameter"
                                                            : "";
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        v.name, role, v.size, markupEscaped(v.unit), markupEscaped(v.description));
  }
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>ballbot "
      "plant</title></head><body>\n"
      "<h1>Ballbot plant</h1>\n<p>{}</p>\n"
      "<p>Rigid bodies, rolling ball, series elastic drives and sensors of a robot that balances "
      "on a ball, as "
      "simulated by ballbot {}. Commands are held during a step and act within it. Time is counted "
      "in whole "
      "nanoseconds inside. Equal calls give equal bits, also after restoring a saved state, here "
      "or in another "
      "process. Frames: world with z up; base with x forward and its origin at the ball "
      "centre.</p>\n"
      "<p>Inputs that nobody sets are zero: the robot falls. Parameters have the names they have "
      "in ballbot's "
      "scenario files and can be set until initialization ends.</p>\n"
      "<p>Needs Linux on x86-64 with AVX2, glibc 2.36 and the C++ library of GCC 12, or later. "
      "Everything else it "
      "needs is in this archive; see licenses.</p>\n"
      "<table>\n<tr><th>variable</th><th></th><th>size</th><th>unit</th><th>meaning</th></tr>\n{}</"
      "table>\n"
      "</body></html>\n",
      markupEscaped(facts.description), facts.version, rows);
}

}  // namespace

std::string defaultFmuLibraries() {
  return (fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "lib/ballbot/fmu")
      .string();
}

void exportFmu(const ConfigNode& scenario, const std::string& urdf_path, const FmuExport& how,
               const std::string& path) {
  if (how.fmi_version != 2 && how.fmi_version != 3) {
    throw InputError(fmt::format("FMI version is {}, must be 2 or 3", how.fmi_version));
  }
  const fs::path libraries = fs::path(how.libraries_folder) / fmt::format("fmi{}", how.fmi_version);
  const std::string module = std::string(kModelIdentifier) + ".so";
  if (!fs::exists(libraries / "binaries" / module)) {
    throw InputError(fmt::format(
        "{}: there is no {} for FMI {} here. In the folder where this program was built, try: "
        "./bootstrap build; an installed one must be installed whole",
        libraries.string(), module, how.fmi_version));
  }
  const ConfigNode tree = plantScenario(scenario);
  const std::string yaml = toYaml(tree), urdf = readFile(urdf_path);
  const FmuVariables variables(tree);

  ConfigReader in(tree);
  ModelFacts facts;
  facts.token = fmuToken(yaml, urdf, how.fmi_version);
  facts.version = how.program_version;
  facts.description = in.textOr("summary", in.textOr("name", "Ballbot plant"));
  facts.stop_time_s = in.numberOr("duration_s", 10, {kTiny, 1e5});
  facts.internal_step_s = toSeconds(readPlantSubstep(scenario));

  const std::string platform = how.fmi_version == 2 ? "linux64" : "x86_64-linux";
  std::vector<ZipEntry> entries;
  entries.push_back({"modelDescription.xml", how.fmi_version == 2
                                                 ? fmi2ModelDescription(variables, facts)
                                                 : fmi3ModelDescription(variables, facts)});
  entries.push_back({"resources/scenario.yaml", yaml});
  entries.push_back({"resources/robot.urdf", urdf});
  entries.push_back({"documentation/index.html", documentation(variables, facts)});
  // The name under which the standard wants licenses to be found.
  entries.push_back(
      {"documentation/licenses/license.txt",
       "Ballbot's own files are under the Apache License 2.0 (ballbot-LICENSE.txt). What "
       "comes from others is named in ballbot-NOTICE.txt; its licenses are the other "
       "files beside this one, named by their Debian packages.\n"});
  for (const fs::path& file : filesIn(libraries / "licenses")) {
    entries.push_back({"documentation/licenses/" + file.filename().string(), readFile(file)});
  }
  for (const fs::path& file : filesIn(libraries / "binaries")) {
    entries.push_back(
        {"binaries/" + platform + "/" + file.filename().string(), readFile(file), true});
  }
  writeZip(path, entries);
}

}  // namespace ballbot
