#include "cosim/session_id.hpp"

#include <random>

namespace ballbot {

std::uint64_t drawSessionId() {
  std::random_device random;
  const std::uint64_t high = random();
  return high << 32 | random() | 1;  // never 0
}

}  // namespace ballbot
