#include "tests/fmi/spring_support.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

#include "fmi/zip_archive.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

std::string bytesOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

struct SpringFile {
  std::string path = fs::temp_directory_path() / ("spring" + std::to_string(::getpid()) + ".fmu");
  SpringFile() {
    writeZip(
        path,
        {{"modelDescription.xml", bytesOf(BALLBOT_SOURCE_DIR "/tests/fmi/spring_fmu.xml")},
         {"binaries/linux64/spring.so", bytesOf(BALLBOT_BIN_DIR "/../tests/spring.so"), true}});
  }
  ~SpringFile() { fs::remove(path); }
};

}  // namespace

const std::string& springFmu() {
  static const SpringFile file;
  return file.path;
}

}  // namespace ballbot
