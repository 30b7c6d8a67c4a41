#pragma once

#include <filesystem>
#include <string>

#include <unistd.h>

#include "experiment/text_file.hpp"
#include "studies/study_definition.hpp"

namespace ballbot {

/// A study read from text, as if it stood in a file of that content.
inline Study studyOf(const std::string& text) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("study_" + std::to_string(::getpid()) + ".yaml"))
          .string();
  writeTextFile(path, "name: tried\nscenario: balance.yaml\n" + text);
  struct Remove {
    std::string path;
    ~Remove() { std::filesystem::remove(path); }
  } remove{path};
  return loadStudy(path);
}

}  // namespace ballbot
