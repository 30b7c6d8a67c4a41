#pragma once

#include <array>
#include <vector>

#include "model/signals.hpp"
#include "plant/sensors.hpp"
#include "plant/torque_drive.hpp"

namespace ballbot {

struct PlantConfig;

/// The six drives as one: their encoders, their torque loops, and the way of a command to them,
/// which takes a whole number of ticks. Sensing and acting of one tick are apart because what is
/// sensed at a time can still shape the command that is acted on then.
class DriveBank {
 public:
  explicit DriveBank(const PlantConfig& config);

  /// Before the first tick: encoders at their angles, rates zero, no command on its way.
  void reset(const JointMotion& motion);

  /// First half of a tick: reads the encoders.
  void sense(const JointMotion& motion) { encoders_.tick(motion); }
  /// Second half: takes `command` in, and gives the motor torques that the command of
  /// transport_delay_ticks ago asks for [N m].
  JointVector act(const ActuatorCommand& command);

  const JointEncoders& encoders() const { return encoders_; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.encoders_);
    visit(self.drives_);
    visit(self.ticks_);
    visit(self.inserted_delay_);
    visit(self.on_the_way_);
  }

 private:
  /// The wheels' wanted torques as they come out of a gain and delay put into their loop [N m].
  void passInsertion(JointVector& wanted);

  JointEncoders encoders_;
  std::vector<TorqueDrive> drives_;
  std::int64_t ticks_ = 0;
  std::vector<ActuatorCommand> on_the_way_;  ///< ring, one more than the delay
  double inserted_gain_;
  std::vector<Vector3> inserted_delay_;  ///< wheel torques wanted, ring; empty without a delay
};

}  // namespace ballbot
