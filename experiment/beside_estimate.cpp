#include "experiment/beside_estimate.hpp"

#include <string>

namespace ballbot {
namespace {

using Known = BesideEstimate;

void addSpin(std::vector<BesideSignal>& out) {
  out.push_back({{"ball_spin_rate", "rad/s", "estimated spin of the ball about the vertical"},
                 [](const Known& known, int) { return known.estimate.spin_rate; }});
  out.push_back({{"sigma_ball_spin_rate", "rad/s", "one standard deviation of ball_spin_rate"},
                 [](const Known& known, int) { return known.estimate.spin_rate_sigma; }});
  out.push_back(
      {{"floor_spin_torque_held", "N m", "what the floor is counted on to hold of that spin"},
       [](const Known& known, int) { return known.floor_held; }});
}

void addLastingForces(std::vector<BesideSignal>& out) {
  out.push_back({{"lasting_hand_mass", "kg", "mass in the hand that the model does not know of"},
                 [](const Known& known, int) { return known.lasting.forces().hand_mass; }});
  static constexpr const char* kBase[kArmRate1] = {"force_x", "force_y", "moment_x", "moment_y",
                                                   "moment_z"};
  for (int i = 0; i < kVelocityDim; ++i) {
    const bool force = i < kOmegaX, moment = !force && i < kArmRate1;
    const std::string row =
        i < kArmRate1 ? kBase[i] : "arm_torque_" + std::to_string(i - kArmRate1 + 1);
    out.push_back({{"lasting_" + row, force ? "N" : "N m",
                    force    ? "lasting force along the floor that the model does not know of"
                    : moment ? "the same, moment about the ball's centre in the base's axes"
                             : "the same, torque in a joint of the arm"},
                   [](const Known& known, int row) { return known.lasting.forces().rest[row]; },
                   i});
  }
  out.push_back({{"lasting_force_learned", "", "1 while it is learned, 0 while it is kept"},
                 [](const Known& known, int) { return known.lasting.learning() ? 1.0 : 0.0; }});
}

void addPushes(std::vector<BesideSignal>& out) {
  const auto force = [](const Known& known, int row) { return known.push.force()[row]; };
  out.push_back({{"push_force_x", "N", "push that plans count on, along x of W"}, force, kBallVx});
  out.push_back({{"push_force_y", "N", "push that plans count on, along y of W"}, force, kBallVy});
}

}  // namespace

std::vector<BesideSignal> besideEstimate(bool spin, bool lasting_forces, bool pushes) {
  std::vector<BesideSignal> out;
  if (spin) addSpin(out);
  if (lasting_forces) addLastingForces(out);
  if (pushes) addPushes(out);
  return out;
}

}  // namespace ballbot
