#pragma once

#include <array>
#include <string>

namespace ballbot {

/// One thing that a person does to the robot while it is held, or that is done to it.
struct CommissioningTask {
  enum class Kind {
    kStandStill,  ///< the robot in its stand, the arm at its zero marks
    kTurnJoint,   ///< by hand, no voltage
    kTiltBase,    ///< by hand, no voltage
    kUpright,     ///< back in its stand, between two of them
    kTorque,      ///< the drive gets low torque; hands off
  };
  Kind kind = Kind::kStandStill;
  int drive = -1;                ///< 0 to 5, of kTurnJoint and kTorque
  double angle = 0;              ///< to be turned by, positive direction [rad]
  std::array<double, 3> axis{};  ///< of kTiltBase, unit vector in B
  std::string name;              ///< "turn wheel 1"
  std::string text;              ///< what to do, in words
};

/// Whoever carries the tasks out: a person before a terminal, or an emulated one.
class CommissioningPerson {
 public:
  virtual ~CommissioningPerson() = default;
  /// Do this now.
  virtual void begin(const CommissioningTask& task) = 0;
  /// What was seen of it: "all right", or what is wrong.
  virtual void hear(const CommissioningTask& task, const std::string& words) = 0;
  /// Asked once, before the first torque. @return whether it may come
  virtual bool allowsTorque() = 0;
};

}  // namespace ballbot
