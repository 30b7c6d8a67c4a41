#pragma once

#include <memory>

#include "controller/lasting_force.hpp"
#include "core/state_blob.hpp"
#include "estimator/contact_force_observer.hpp"
#include "estimator/estimator.hpp"
#include "experiment/run_config.hpp"
#include "model/reports.hpp"
#include "model/robot_parameters.hpp"

namespace ballbot {

/// All that a controller makes of sensor frames before it decides anything: the estimator and the
/// contact force observer, one frame per period of the estimator. The controller process and the
/// replay of a log use this one class, so they cannot differ.
class RobotSensing {
 public:
  explicit RobotSensing(const RunConfig& config);

  /// Frames in the order of time. Free of allocation; for the control step.
  void update(const SensorFrame& frame) noexcept;

  const Estimator& estimator() const { return *estimator_; }
  /// State brought forward to `now`.
  StateEstimate estimate(SimTime now) const noexcept { return estimator_->estimate(now); }
  /// Environment on the end-effector, in W [N]; zero while held.
  const Vector3& contactForce() const noexcept { return contact_force_.force(); }
  /// Of the forces on the robot, what neither the model nor what lasts explains, in the rows of nu;
  /// zero while held.
  VelocityVector unexplainedForce() const noexcept {
    return contact_force_.residual() - lasting_.forces().rest;
  }
  /// What lasts of that which the model does not explain; none while held.
  const LastingForce& lasting() const noexcept { return lasting_; }
  /// As it goes on record; the tick is the recorder's.
  StateEstimate write(SimTime now, EstimateFrame& out) const noexcept;

  /// What goes on from one frame to the next; the estimator's part sealed by itself.
  struct State {
    StateBlob estimator;
    ContactForceObserver contact_force;
    LastingForce lasting;
    std::int64_t wheels_refused;

    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.estimator);
      visit(self.contact_force);
      visit(self.lasting);
      visit(self.wheels_refused);
    }
  };
  State state() const {
    return {estimator_->saveState(), contact_force_, lasting_, wheels_refused_};
  }
  /// @throw InputError if the estimator refuses its part; nothing has changed then.
  void restore(const State& state);

 private:
  void learnLasting(const SensorFrame& frame, const StateEstimate& e) noexcept;
  /// Estimator and observer count on the mass that is learned.
  void tellHand() noexcept;

  SimTime release_;
  std::unique_ptr<Estimator> estimator_;
  ContactForceObserver contact_force_;
  LastingForce lasting_;
  std::int64_t wheels_refused_ = 0;  ///< intervals of them, so far
};

}  // namespace ballbot
