#pragma once

#include <string>

#include "controller/law_settings.hpp"
#include "controller/mpc_planner.hpp"

namespace ballbot {

class ConfigReader;

/// What was read of a law that solves the whole-body problem, or a part of it, anew and anew.
class MpcSettings : public LawSettings {
 public:
  /// Reads `mpc:`, and `lqr:` where it is there, of the controller's section.
  /// @throw InputError
  MpcSettings(ConfigReader& controller, const RobotParameters& robot);

  std::unique_ptr<ControlLaw> makeLaw() const override;
  std::unique_ptr<ControlLaw> makeLawAtRest(SimTime at) const override;
  std::shared_ptr<const MotionReference> reference() const override;
  Constraints limits() const override { return config_.constraints; }
  std::optional<QuadraticCost> costAt(SimTime at, const ArmVector& arm) const override;
  std::vector<AddedSignal> addedToPlan() const override;
  bool shapesWheelTorques() const override { return true; }
  /// A plan must still count when the next one takes over.
  void requireRates(SimDuration period, SimDuration latency) const override;

 protected:
  const MpcConfig& config() const { return config_; }

 private:
  MpcConfig config_;
  std::string fallback_after_;  ///< the key and where it was read
};

}  // namespace ballbot
