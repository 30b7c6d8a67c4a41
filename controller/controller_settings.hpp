#pragma once

#include <memory>
#include <string>

#include "controller/floor_belief.hpp"
#include "controller/law_settings.hpp"
#include "controller/lost_wheels.hpp"
#include "controller/offset_free.hpp"
#include "controller/pd_tracker.hpp"
#include "controller/push_belief.hpp"

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

/// The `controller:` section of a scenario, read:
///
///     known_payload_kg: 0.5
///     floor: {spin_torque_Nm: 0.4}
///     wheel_loss: {counted_out: true}
///     tracker: {...}
///     kind: lqr        # | mpc | decoupled, and what was added to lawKinds()
///     lqr: {...}
struct ControllerSettings {
  RobotParameters believed_robot;  ///< with the payload that estimator and law count on
  TrackerConfig tracker;
  FloorBelief floor;
  WheelLoss wheel_loss;
  PushBelief push;
  OffsetFree offset_free;
  std::shared_ptr<const LawSettings> law;

  /// Sections of other laws than the chosen one are passed over, so that one file can hold several
  /// to choose from.
  /// @param robot  empty-handed
  /// @throw InputError for what cannot be read or cannot be balanced.
  static ControllerSettings read(ConfigReader& in, const RobotParameters& robot);

  /// @throw InputError if no such law balances this robot.
  std::unique_ptr<ControlLaw> makeLaw() const;

 private:
  std::string kind_;  ///< the key and where it was read
  std::string law_;   ///< that stands there, and whose code may be anybody's
};

/// Tells of the whole `controller:` section, of every law and of what others read from it: its
/// keys, and what they mean where the file says nothing.
/// @throw NumericalError if the robot's nominal pose has no equilibrium.
void describeController(ConfigVisitor& v, const RobotParameters& robot);

}  // namespace ballbot
