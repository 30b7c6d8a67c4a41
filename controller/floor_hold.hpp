#pragma once

#include "controller/floor_belief.hpp"
#include "controller/spin_torque.hpp"
#include "core/time.hpp"

namespace ballbot {

/// Learns while the robot runs what torque about the vertical the floor holds the ball with. Over a
/// window of time the momentum of ball and wheels about the vertical balances
///
///   I s - rho I_w z . R D^T w |  =  integral of (R T)_z - f
///
/// s: the ball's spin; w: the wheels' spins about their axles; (R T)_z: their torque on the ball
/// (SpinTorque), f: the floor's. Of a ball that spins all the window, f is what the floor holds; of
/// one that does not, it holds at least f. Without a derivative of anything measured. Free of
/// allocation; for the control step.
class FloorHold {
 public:
  FloorHold(const RobotParameters& robot, const FloorBelief& settings);

  /// One frame of the estimator. One that is not finite, and a gap, end a window that tells
  /// nothing. @param spin_rate  of the ball, as estimated [rad/s]
  /// @param joint_torque  of the springs [N m], @param joint_velocity  [rad/s]
  void update(SimTime now, const StateVector& x, double spin_rate, const JointVector& joint_torque,
              const JointVector& joint_velocity) noexcept;

  /// What the floor is counted on to hold; kUnlimited without end [N m].
  double held() const noexcept { return held_; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.held_);
    visit(self.ceiling_);
    visit(self.window_);
  }

 private:
  struct Window {
    bool open = false;
    SimTime begin{}, last{};
    double momentum = 0;              ///< at its begin [N m s]
    double impulse = 0;               ///< of the wheels' torque so far [N m s]
    double slowest = 0, fastest = 0;  ///< spin in it [rad/s]

    template <typename Self, typename Visitor>
    static void visitState(Self& self, Visitor& visit) {
      visit(self.open);
      visit(self.begin);
      visit(self.last);
      visit(self.momentum);
      visit(self.impulse);
      visit(self.slowest);
      visit(self.fastest);
    }
  };
  void learn(double wheels, double floor, double duration) noexcept;

  FloorBelief settings_;
  SpinTorque spin_torque_;
  Matrix3 axles_;  ///< D
  double ball_inertia_, wheel_inertia_;
  double held_;
  double ceiling_;  ///< of what is tried in addition [N m]
  Window window_;
};

}  // namespace ballbot
