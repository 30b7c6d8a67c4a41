#include "tests/fmi/fmu_fixture.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include <unistd.h>

#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "fmi/fmu_export.hpp"
#include "fmi/zip_archive.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fmu test ä" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

UnpackedFmu makeFmu(int version) {
  static const Folder folder;
  UnpackedFmu out;
  out.file = (folder.path / ("plant" + std::to_string(version) + ".fmu")).string();
  out.folder = (folder.path / ("fmi " + std::to_string(version))).string();
  FmuExport how;
  how.fmi_version = version;
  how.program_version = "0.0.0";
  how.libraries_folder = BALLBOT_BIN_DIR "/../lib/ballbot/fmu";
  exportFmu(testScenario(), testUrdf(), how, out.file);
  fs::create_directories(out.folder);
  unpackZip(out.file, out.folder);
  out.description = readFmuDescription(out.file);
  return out;
}

}  // namespace

ConfigNode testScenario() {
  ConfigNode tree = loadYamlFile(BALLBOT_SOURCE_DIR "/configs/scenarios/balance.yaml");
  applyOverride(tree, "initial.release_s=0.02");
  return tree;
}

std::string testUrdf() { return BALLBOT_SOURCE_DIR "/configs/robots/ballbot.urdf"; }

const UnpackedFmu& unpackedFmu(int fmi_version) {
  static const UnpackedFmu two = makeFmu(2), three = makeFmu(3);
  return fmi_version == 2 ? two : three;
}

ValueReference UnpackedFmu::reference(const std::string& name) const {
  const ImportedVariable* v = description.find(name);
  if (!v) throw std::runtime_error("no variable " + name);
  return v->reference;
}

std::vector<double> busyCommand(int step) {
  const double s = std::sin(0.1 * step), c = std::cos(0.07 * step);
  return {0.4 * s, -0.3 * c, 0.2,  0.5, -2 * c, s,     // torque
          0,       0,        0,    0,   -0.6,   2.17,  // position
          0,       0,        0,    s,   0,      0,     // velocity
          0.2,     0.2,      0.2,  8,   8,      8,     // stiffness
          0.02,    0.02,     0.02, 0.6, 0.6,    0.6};  // damping
}

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "nothing was thrown";
}

}  // namespace ballbot
