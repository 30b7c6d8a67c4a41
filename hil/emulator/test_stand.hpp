#pragma once

#include <cstdint>

namespace ballbot {

/// What becomes of a joint's output on a test stand; the numbers are those of object 2020:01.
enum class StandOutput : std::uint8_t {
  kBlocked = 1,  ///< held still
  kFree = 2,     ///< turns its load
  kTurned = 3,   ///< a hand turns it while there is torque
};

/// What a test stand in the robot's place offers beyond its sensors.
class TestStand {
 public:
  virtual ~TestStand() = default;
  virtual StandOutput output(int joint) const = 0;
  virtual void setOutput(int joint, StandOutput output) = 0;
  /// Mean over the last step, as the motor's current shows it, joint side of the gear [N m].
  virtual double motorTorque(int joint) const = 0;
};

}  // namespace ballbot
