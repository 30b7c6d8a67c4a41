#pragma once

#include "core/time.hpp"
#include "model/state.hpp"

namespace ballbot {

class ConfigVisitor;

/// What is made of a force that acts now and that neither model nor contact explains: a push.
struct PushBelief {
  bool counted_on = true;
  /// Time over which plans let it fade [s].
  double lasts = 0.5;
  /// Forces along the floor and moments about the ball's centre that are none yet: noise, and what
  /// the model does not know [N], [N m].
  double least_force = 15, least_moment = 7;
  /// For so long after a measurement was refused nothing is believed to be one.
  SimDuration doubted_for = std::chrono::milliseconds(150);

  void describe(ConfigVisitor& v);
};

/// Tells pushes from noise in what the robot's momentum does beyond the model. Taken is a residual
/// of generalised momentum (ContactForceObserver::residual): forces along the floor in W, moments
/// about the ball's centre in B, torques in the arm's joints. Free of allocation; for the control
/// step.
class PushEstimate {
 public:
  explicit PushEstimate(const PushBelief& settings) : settings_(settings) {}

  /// One frame of the estimator.
  /// @param doubtful  something measured was refused, or a wheel is lost
  void update(SimTime now, const VelocityVector& residual, bool doubtful) noexcept;

  /// Zero where there is none; begins at zero above the least that is one [N, N m]. Never about the
  /// vertical: that may be the floor's, on a ball that spins.
  const VelocityVector& force() const noexcept { return force_; }
  const PushBelief& settings() const noexcept { return settings_; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.doubted_until_);
    visit(self.force_);
  }

 private:
  PushBelief settings_;
  SimTime doubted_until_{};
  VelocityVector force_ = VelocityVector::Zero();
};

}  // namespace ballbot
