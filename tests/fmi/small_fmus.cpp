#include "tests/fmi/small_fmus.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

namespace ballbot {
namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("small_fmus" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

std::string fileOf(const std::string& name, std::vector<ZipEntry> entries) {
  const std::string path = smallFmuFolder() + "/" + name + ".fmu";
  writeZip(path, entries);
  return path;
}

}  // namespace

std::string smallFmuFolder() {
  static const Folder folder;
  return folder.path.string();
}

std::string fmi2Xml(const std::string& variables, const std::string& types) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<fmiModelDescription fmiVersion=\"2.0\" modelName=\"small\" guid=\"{g}\">"
         "<CoSimulation modelIdentifier=\"small\" "
         "canHandleVariableCommunicationStepSize=\"true\"/>" +
         types + "<ModelVariables>" + variables + "</ModelVariables><ModelStructure/>" +
         "</fmiModelDescription>\n";
}

std::string fmi3Xml(const std::string& variables, const std::string& more) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<fmiModelDescription fmiVersion=\"3.0\" modelName=\"small\" instantiationToken=\"t\">"
         "<CoSimulation modelIdentifier=\"small\" "
         "canHandleVariableCommunicationStepSize=\"true\"/>" +
         more + "<ModelVariables>" + variables + "</ModelVariables><ModelStructure/>" +
         "</fmiModelDescription>\n";
}

std::string fmi2File(const std::string& name, const std::string& variables,
                     const std::string& types, const std::vector<ZipEntry>& more) {
  std::vector<ZipEntry> entries = {{"modelDescription.xml", fmi2Xml(variables, types)},
                                   {"binaries/linux64/small.so", "none", true}};
  entries.insert(entries.end(), more.begin(), more.end());
  return fileOf(name, entries);
}

std::string fmi3File(const std::string& name, const std::string& variables,
                     const std::string& more_xml) {
  return fileOf(name, {{"modelDescription.xml", fmi3Xml(variables, more_xml)},
                       {"binaries/x86_64-linux/small.so", "none", true}});
}

std::string scalar(const std::string& name, const std::string& causality, const std::string& type,
                   int reference) {
  return "<ScalarVariable name=\"" + name + "\" valueReference=\"" + std::to_string(reference) +
         "\" causality=\"" + causality + "\"><" + type + "/></ScalarVariable>";
}

std::string valuesFmu() {
  std::string variables;
  int reference = 0;
  for (const char* type : {"Float32", "Float64", "Int8", "UInt8", "Int16", "UInt16", "Int32",
                           "UInt32", "Int64", "UInt64", "Boolean"}) {
    ++reference;
    for (const bool output : {false, true}) {
      variables += std::string("<") + type + " name=\"" + (output ? "out_" : "in_") + type +
                   "\" valueReference=\"" + std::to_string(output ? 100 + reference : reference) +
                   "\" causality=\"" + (output ? "output" : "input") + "\"/>";
    }
  }
  variables +=
      "<Float64 name=\"A\" valueReference=\"200\" causality=\"output\"><Dimension start=\"3\"/>"
      "<Dimension start=\"3\"/></Float64>"
      "<UInt64 name=\"huge\" valueReference=\"201\" causality=\"output\"/>";
  std::ifstream in(BALLBOT_BIN_DIR "/../tests/values.so", std::ios::binary);
  std::ostringstream library;
  library << in.rdbuf();
  return fileOf("values", {{"modelDescription.xml", fmi3Xml(variables)},
                           {"binaries/x86_64-linux/small.so", library.str(), true}});
}

}  // namespace ballbot
