#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "cosim/transport.hpp"

namespace ballbot {

class ConfigReader;

/// What is done to messages on their way. Probabilities of each, 0 to 1.
struct DisturbanceOptions {
  std::uint64_t seed = 1;
  double loss = 0;
  double duplication = 0;
  double reordering = 0;                         ///< held back so that later ones overtake it
  std::chrono::microseconds reorder_delay{500};  ///< how long it is held back
  std::chrono::microseconds delay{0};            ///< of every message, at least
  std::chrono::microseconds jitter{0};           ///< more delay, uniform from 0 to this

  /// @throw InputError for a probability outside 0 to 1 or a negative time.
  void check() const;
};

/// Decides the fate of each message of one direction from its number alone, so that the same seed
/// does the same to message k whatever the timing.
class Disturbance {
 public:
  Disturbance(const DisturbanceOptions& options, const std::string& direction);

  /// After how long each copy of message `index` is delivered; empty: it is lost.
  void decide(std::uint64_t index, std::vector<std::chrono::microseconds>& copies) const;

 private:
  DisturbanceOptions options_;
  RandomStream random_;
};

}  // namespace ballbot
