#pragma once

#include "controller/offset_free.hpp"
#include "core/time.hpp"
#include "model/state.hpp"

namespace ballbot {

/// Learns what of the forces that the model does not explain is there to stay. Taken is a residual
/// of generalised momentum (ContactForceObserver::residual): forces along the floor in W, moments
/// about the ball's centre in B, torques in the arm's joints. A push comes and goes: what has
/// changed within `settled_after` is not learned, and neither is anything while the caller says
/// that it has another reason. Free of allocation; for the control step.
class LastingForce {
 public:
  explicit LastingForce(const OffsetFree& settings);

  /// One frame of the estimator. One that is not finite is passed over.
  /// @param residual   not explained by the model [N, N m]
  /// @param explained  what else explains it now: a contact, a ball that spins, a wheel that slips
  void update(SimTime now, const VelocityVector& residual, bool explained) noexcept;
  /// The robot is held: what it feels is the stand.
  void reset() noexcept;

  /// That plans count on, in the rows of nu [N, N m]; zero where nothing is learned.
  const VelocityVector& force() const noexcept { return force_; }
  /// Whether the last frame was learned from.
  bool learning() const noexcept { return learning_; }
  const OffsetFree& settings() const noexcept { return settings_; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.started_);
    visit(self.learning_);
    visit(self.last_);
    visit(self.settled_since_);
    visit(self.reference_);
    visit(self.force_);
  }

 private:
  OffsetFree settings_;
  VelocityVector change_, limit_;
  bool started_ = false;
  bool learning_ = false;
  SimTime last_{};
  SimTime settled_since_{};
  VelocityVector reference_ = VelocityVector::Zero();  ///< from which no change is counted
  VelocityVector force_ = VelocityVector::Zero();
};

}  // namespace ballbot
