#pragma once

#include <cstddef>
#include <vector>

#include "model/external_forces.hpp"
#include "model/signals.hpp"
#include "model/truth.hpp"

namespace ballbot {

enum class SignalKind {
  kReal,   ///< continuous
  kCount,  ///< a whole number, below 2^53
  kTime,   ///< whole nanoseconds inside, seconds outside
};

/// One named quantity of a frame: what the messages and the FMU's variables are made from. All its
/// elements have one unit, so a message field of several (q: metres and radians) is several rows.
template <typename Frame>
struct Signal {
  const char* message_field;  ///< field of the frame's .lcm type that carries it
  const char* name;           ///< unique within the frame
  int size;
  SignalKind kind;
  const char* unit;  ///< SI, as in the .lcm file; empty where there is none
  const char* description;
  /// All elements as doubles, in order, without loss of a bit; times in seconds.
  void (*read)(const Frame& from, double* to);
  void (*write)(Frame& to, const double* from);
};

/// A frame as a row of numbers, in the order of its signals. Its time is not in it.
template <typename Frame>
std::size_t rowSize(const std::vector<Signal<Frame>>& signals) {
  std::size_t size = 0;
  for (const auto& signal : signals) size += static_cast<std::size_t>(signal.size);
  return size;
}
template <typename Frame>
void readSignals(const std::vector<Signal<Frame>>& signals, const Frame& from, double* to) {
  for (const auto& signal : signals) {
    signal.read(from, to);
    to += signal.size;
  }
}
template <typename Frame>
void writeSignals(const std::vector<Signal<Frame>>& signals, const double* from, Frame& to) {
  for (const auto& signal : signals) {
    signal.write(to, from);
    from += signal.size;
  }
}

/// Every quantity of the frames, in the order of the messages. The time a frame holds for is
/// not among them: whoever exchanges frames knows it.
const std::vector<Signal<ActuatorCommand>>& commandSignals();
/// In no message: forces come from whoever imports the plant. Their message_field is empty.
const std::vector<Signal<ExternalForces>>& externalForceSignals();
const std::vector<Signal<SensorFrame>>& sensorSignals();
const std::vector<Signal<TruthFrame>>& truthSignals();

}  // namespace ballbot
