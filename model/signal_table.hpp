#pragma once

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

/// Every quantity of the frames, in the order of the messages. The time a frame holds for is
/// not among them: whoever exchanges frames knows it.
const std::vector<Signal<ActuatorCommand>>& commandSignals();
/// In no message: forces come from whoever imports the plant. Their message_field is empty.
const std::vector<Signal<ExternalForces>>& externalForceSignals();
const std::vector<Signal<SensorFrame>>& sensorSignals();
const std::vector<Signal<TruthFrame>>& truthSignals();

}  // namespace ballbot
