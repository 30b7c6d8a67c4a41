#include "plant/floor_truth.hpp"

namespace ballbot {

const std::vector<AddedSignal>& FloorTruth::list() {
  static const std::vector<AddedSignal> signals = {
      {"ball_spin_rate", "rad/s", "true spin of the ball about the vertical"},
      {"floor_spin_torque", "N m", "true torque of the floor on the ball about the vertical"},
      {"floor_spin_torque_held", "N m", "the largest that this torque can be where the ball is"},
  };
  return signals;
}

FloorTruth::FloorTruth(const PlantConfig& config) {
  if (config.fidelity.contact == ContactLevel::kRolling) return;
  signals_.list = list();
  signals_.values.assign(signals_.list.size(), 0.0);
}

void FloorTruth::observe(const BallOnFloor& ball) noexcept {
  signals_.values[kSpinRate] = ball.spin_rate;
  signals_.values[kTorque] = ball.torque;
  signals_.values[kHeld] = ball.held;
}

}  // namespace ballbot
