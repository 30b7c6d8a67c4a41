#include "plant/added_truth.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace ballbot {
namespace {

std::vector<AddedSignal> allSignals() {
  std::vector<AddedSignal> all = {
      {"ball_spin_rate", "rad/s", "true spin of the ball about the vertical"},
      {"floor_spin_torque", "N m", "true torque of the floor on the ball about the vertical"},
      {"floor_spin_torque_held", "N m", "the largest that this torque can be where the ball is"},
  };
  const auto perWheel = [&](const char* name, const char* unit, const char* words) {
    for (int i = 1; i <= kWheelCount; ++i) {
      all.push_back({fmt::format("wheel_{}_{}", i, name), unit, words});
    }
  };
  perWheel("normal_force", "N", "true force of the ball on the wheel along the contact's normal");
  perWheel("traction", "N", "true force of the ball on the wheel along its direction of driving");
  perWheel("slip", "m/s", "true velocity of the wheel's rim against the ball");
  return all;
}

}  // namespace

const std::vector<AddedSignal>& AddedTruth::list() {
  static const std::vector<AddedSignal> all = allSignals();
  return all;
}

AddedTruth::AddedTruth(const PlantConfig& config)
    : spins_(config.fidelity.contact != ContactLevel::kRolling), wheels_(config.knowsWheels()) {
  const auto first = list().begin(), wheels = first + kNormalForce;
  if (spins_) signals_.list.assign(first, wheels);
  if (wheels_) signals_.list.insert(signals_.list.end(), wheels, list().end());
  signals_.values.assign(signals_.list.size(), 0.0);
}

void AddedTruth::observe(const BallOnFloor& ball, const WheelContacts& wheels) noexcept {
  double* to = signals_.values.data();
  if (spins_) {
    for (const double value : {ball.spin_rate, ball.torque, ball.held}) *to++ = value;
  }
  if (!wheels_) return;
  for (const Vector3* values : {&wheels.normal_force, &wheels.traction, &wheels.slip}) {
    to = std::copy_n(values->data(), kWheelCount, to);
  }
}

std::vector<std::size_t> AddedTruth::placesOf(const AddedSignals& signals) {
  std::vector<std::size_t> places;
  for (const AddedSignal& signal : signals.list) {
    const auto at = std::find_if(list().begin(), list().end(),
                                 [&](const AddedSignal& s) { return s.name == signal.name; });
    places.push_back(static_cast<std::size_t>(at - list().begin()));
  }
  return places;
}

}  // namespace ballbot
