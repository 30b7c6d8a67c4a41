#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// One thing about this machine that runs depend on.
struct MachineCheck {
  enum class Level { kOk, kWarning, kBroken };
  std::string name;
  Level level = Level::kOk;
  std::string found;  ///< what was seen, with numbers
  std::string mend;   ///< the command that mends it; empty if nothing is wrong
};

/// Looks at multicast on the loopback, socket buffers, processors, real-time rights, locked memory
/// and free disk space. Changes nothing.
std::vector<MachineCheck> checkMachine();

}  // namespace ballbot
