#pragma once

#include "model/state.hpp"

namespace ballbot {

/// What a model does not know of the forces on the robot, and what is there to stay.
struct LastingForces {
  /// In the hand, beside the mass that the model knows of [kg].
  double hand_mass = 0;
  /// All the rest, in the rows of nu: along the floor in W [N], about the ball's centre in B [N m],
  /// in the arm's joints [N m].
  VelocityVector rest = VelocityVector::Zero();

  bool none() const { return hand_mass == 0 && rest.isZero(0); }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.hand_mass);
    visit(self.rest);
  }
};

}  // namespace ballbot
