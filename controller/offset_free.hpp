#pragma once

#include "core/config_visitor.hpp"

namespace ballbot {

/// How what the model does not know of lasting forces is learned and counted on.
struct OffsetFree {
  bool enabled = true;
  double time_constant = 1;  ///< of what is learned [s]
  /// A force counts as lasting once it has not changed for so long [s] ...
  double settled_after = 0.5;
  /// ... by more than this: of the forces along the floor, of the moments about the ball's centre
  /// and of the arm's torques.
  double force_change_N = 4, moment_change_Nm = 2, arm_change_Nm = 1.5;
  /// Mass in the hand: with which it is learned [s], and as whose force sideways on the hand a
  /// touch is known, while which nothing is learned [N].
  double hand_time_constant = 0.5;
  double touch_N = 1.5;
  /// That is counted on at most.
  double hand_mass_limit_kg = 3;
  double force_limit_N = 20, moment_limit_Nm = 15, arm_limit_Nm = 12;

  void describe(ConfigVisitor& v) {
    v.boolean(may("enabled",
                  "whether forces that last are learned, and plans count on them: a mass in the "
                  "hand, a centre of mass that is off, a slope"),
              enabled);
    v.number(may("time_constant_s", "with which they are learned"), time_constant, {0.05, 100});
    v.number(may("settled_after_s",
                 "time without a change after which a force counts as one that lasts"),
             settled_after, {0, 100});
    v.number(may("force_change_N", "change of a force along the floor"), force_change_N,
             {0.1, 1e3});
    v.number(may("moment_change_Nm", "change of a moment about the ball's centre"),
             moment_change_Nm, {0.1, 1e3});
    v.number(may("arm_change_Nm", "change of a torque in a joint of the arm"), arm_change_Nm,
             {0.1, 1e3});
    v.number(may("hand_time_constant_s", "with which a mass in the hand is learned"),
             hand_time_constant, {0.05, 100});
    v.number(may("touch_N",
                 "force sideways on the hand from which on it touches something, and nothing is "
                 "learned"),
             touch_N, {0.1, 1e3});
    v.number(
        may("hand_mass_limit_kg", "mass in the hand, unknown before, that is counted on at most"),
        hand_mass_limit_kg, {0, 100});
    v.number(may("force_limit_N", "force along the floor that is counted on at most"),
             force_limit_N, {0, 1e3});
    v.number(may("moment_limit_Nm", "moment about the ball's centre that is counted on at most"),
             moment_limit_Nm, {0, 1e3});
    v.number(may("arm_limit_Nm", "torque in a joint of the arm that is counted on at most"),
             arm_limit_Nm, {0, 1e3});
  }
};

}  // namespace ballbot
