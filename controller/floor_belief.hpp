#pragma once

#include "core/config_visitor.hpp"

namespace ballbot {

/// What is believed of the floor: the torque about the vertical with which it holds the ball
/// against a spin. A plan that counts on more falls.
struct FloorBelief {
  bool limited = true;  ///< false: the floor holds whatever the wheels do
  /// At first. Little: a contact patch of 3.5 mm radius, at a friction of 0.8 [N m].
  double spin_torque = 0.4;
  /// Of it, what is commanded at most; a plan keeps within less
  /// (mpc.constraints.spin_torque_limit), to whose feedback this leaves the rest.
  double command_share = 0.8;
  /// Learned from how the ball spins and what holds it; where the spin is estimated.
  bool learned = true;
  double least = 0.1, largest = 2;  ///< that may be learned [N m]
  /// So much is tried in addition, where plans use all that they may, until the ball spins
  /// [N m/s].
  double raised = 0.04;

  void describe(ConfigVisitor& v) {
    v.boolean(may("limited",
                  "whether the floor holds the ball's spin about the vertical by a limited torque, "
                  "which plan and command keep; or by any"),
              limited);
    v.number(may("spin_torque_Nm", "torque that it is believed to hold at first"), spin_torque,
             {0.05, 100});
    v.number(may("command_share", "of that torque, what is commanded at most"), command_share,
             {0.1, 1});
    v.boolean(may("learned",
                  "whether the torque is learned from how the ball spins and what holds it; where "
                  "the estimator knows the spin"),
              learned);
    v.number(may("least_Nm", "that may be learned"), least, {0.01, 100});
    v.number(may("largest_Nm", "that may be learned"), largest, {0.01, 100});
    v.number(may("raised_Nm_per_s",
                 "tried in addition as long as plans use all that they may, until the ball spins"),
             raised, {0, 10});
  }
};

}  // namespace ballbot
