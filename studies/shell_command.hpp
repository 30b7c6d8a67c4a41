#pragma once

#include <string>
#include <vector>

namespace ballbot {

struct CommandEnd {
  int exit_code = -1;  ///< 127 where there is no such program
  std::string out, err;
};

/// Runs a program found on the PATH and waits for it. @throw OutputError if no process can be made
CommandEnd runCommand(const std::vector<std::string>& words);

}  // namespace ballbot
