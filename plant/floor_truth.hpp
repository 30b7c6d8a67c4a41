#pragma once

#include "model/added_signals.hpp"
#include "plant/plant_config.hpp"

namespace ballbot {

/// What the truth knows of a ball that may spin about the vertical, beside its frame.
class FloorTruth {
 public:
  /// Nothing where the ball cannot spin.
  explicit FloorTruth(const PlantConfig& config);

  /// Only where there are signals.
  void observe(const BallOnFloor& ball) noexcept;
  const AddedSignals& signals() const { return signals_; }

  /// Its signals, in order; whoever looks for one finds it by its place here.
  static const std::vector<AddedSignal>& list();
  enum Place : std::size_t { kSpinRate, kTorque, kHeld };

 private:
  AddedSignals signals_;
};

}  // namespace ballbot
