#pragma once

#include "model/added_signals.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {

/// What the truth knows beside its frame, of plants that have it: of a ball that may spin about the
/// vertical, of wheels whose contacts are asked for.
class AddedTruth {
 public:
  /// Signals of what `config` has.
  explicit AddedTruth(const PlantConfig& config);

  void observe(const BallOnFloor& ball, const WheelContacts& wheels) noexcept;
  const AddedSignals& signals() const { return signals_; }

  /// Every signal that a plant can have; those of one are some of them, in this order.
  static const std::vector<AddedSignal>& list();
  /// Where those of `signals` stand in list().
  static std::vector<std::size_t> placesOf(const AddedSignals& signals);

  /// Places in list(); of the wheels' the first of three.
  enum Place : std::size_t {
    kSpinRate,
    kSpinTorque,
    kSpinTorqueHeld,
    kNormalForce,
    kTraction = kNormalForce + kWheelCount,
    kSlip = kTraction + kWheelCount,
    kPlaces = kSlip + kWheelCount
  };

 private:
  bool spins_, wheels_;
  AddedSignals signals_;
};

}  // namespace ballbot
