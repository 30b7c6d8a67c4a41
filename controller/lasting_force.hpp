#pragma once

#include "controller/lasting_forces.hpp"
#include "controller/offset_free.hpp"
#include "core/time.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

/// What is felt in one frame and no model explains: the residual of generalised momentum of a
/// model with the mass in the hand that is counted on (ContactForceObserver).
struct Unexplained {
  VelocityVector residual = VelocityVector::Zero();  ///< as LastingForces::rest [N, N m]
  Vector3 hand_force_W = Vector3::Zero();            ///< of it, on the end-effector [N]
  /// Something else explains it: a ball that spins, wheels that slip.
  bool otherwise = false;
};

/// Learns what of the forces that the model does not explain is there to stay. What hangs in the
/// hand comes first: the arm's own torques tell it, whatever acts on base and ball. A push comes
/// and goes: what has changed within `settled_after` is not learned, and neither is anything while
/// the hand is pushed sideways, for then it touches something. Free of allocation; for the control
/// step.
class LastingForce {
 public:
  /// @param robot  as the model knows it
  LastingForce(const RobotParameters& robot, const OffsetFree& settings);

  /// One frame of the estimator. One that is not finite is passed over.
  void update(SimTime now, const Unexplained& felt) noexcept;
  /// The robot is held: what it feels is the stand.
  void reset() noexcept;

  /// That plans count on; none where nothing is learned.
  const LastingForces& forces() const noexcept { return forces_; }
  /// Whether nothing to speak of is felt in the hand but the mass that is counted on.
  bool handKnown() const noexcept { return hand_known_; }
  /// The mass in the hand, known and learned [kg].
  double handMass() const noexcept { return known_payload_ + forces_.hand_mass; }
  /// Whether the last frame was learned from.
  bool learning() const noexcept { return learning_; }
  bool enabled() const noexcept { return settings_.enabled; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.started_);
    visit(self.learning_);
    visit(self.hand_known_);
    visit(self.last_);
    visit(self.settled_since_);
    visit(self.hand_settled_since_);
    visit(self.reference_);
    visit(self.hand_reference_);
    visit(self.hand_force_);
    visit(self.hand_weight_);
    visit(self.smooth_);
    visit(self.forces_);
  }

 private:
  void learnHand(SimTime now, double dt, const Vector3& force_W, bool otherwise) noexcept;
  void learnRest(SimTime now, double dt, bool otherwise) noexcept;

  OffsetFree settings_;
  double known_payload_, gravity_;
  VelocityVector change_, limit_;
  bool started_ = false;
  bool learning_ = false;
  bool hand_known_ = true;
  SimTime last_{};
  SimTime settled_since_{}, hand_settled_since_{};
  /// From which no change is counted.
  VelocityVector reference_ = VelocityVector::Zero();
  double hand_reference_ = 0;                       ///< weight in the hand, felt and counted on [N]
  double hand_weight_ = 0;                          ///< the same, smoothed [N]
  Vector3 hand_force_ = Vector3::Zero();            ///< smoothed [N]
  VelocityVector smooth_ = VelocityVector::Zero();  ///< residual, smoothed
  LastingForces forces_;
};

}  // namespace ballbot
