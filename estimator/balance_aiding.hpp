#pragma once

#include "estimator/information_filter.hpp"
#include "estimator/joint_history.hpp"
#include "model/contact_momentum.hpp"

namespace ballbot {

class ConfigVisitor;

struct BalanceSettings {
  bool enabled = true;
  /// Of robot and ball about the contact with the floor, as encoders and gyroscope tell it: white,
  /// per window's end [kg m^2/s].
  double momentum_sigma = 0.02;
  /// What the model does not know of the moment about that point: 0.4 mm of a centre of mass of 25
  /// kg are 0.1 N m [N m].
  double moment_sigma = 0.1;
  double window_s = 0.1;
  /// Chi-square (2) of a window above which something pushes, and the tilt is not to blame.
  double push_chi_square = 12;

  void describe(ConfigVisitor& v);
};

/// Tilt from the way the robot falls. An accelerometer at rest cannot tell its bias from a tilt;
/// the robot can, for it does not stay where its centre of mass is not above the ball. Window by
/// window the change of its angular momentum about the contact is held against the moment of
/// gravity at the estimated tilt: what differs is a tilt error, or something that pushes. A push is
/// far larger than a tilt error can be once the tilt is known, and such windows are passed over,
/// with the one that follows. Never makes the tilt surer than the model's own moment is known. Free
/// of allocation; for the control step.
class BalanceAiding {
 public:
  /// @param robot  as the estimator believes it, payload included
  BalanceAiding(const RobotParameters& robot, const BalanceSettings& settings);

  /// The filter has made a step of `h` that ends at `time`; corrects it where a window is full.
  template <int kDim>
  void step(double h, SimTime time, const JointHistory& joints,
            BasicInformationFilter<kDim>& filter) noexcept;
  /// What hangs in the hand: mass [kg], and whether that is all of it. While it is not, a tilt and
  /// a weight are one to this, and the tilt is left alone.
  void setHand(double mass, bool known) noexcept;
  /// The last interval was not measured: the window begins anew.
  void interrupt() noexcept { begun_ = false; }

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.begun_);
    visit(self.pushed_);
    visit(self.elapsed_);
    visit(self.momentum_);
    visit(self.explained_);
    visit(self.moment_);
    visit(self.height_moment_);
  }

 private:
  /// By how much gravity's moment grows with a tilt about the ball's centre [N m/rad].
  double tiltStiffness() const noexcept {
    return dynamics_.robot().gravity * (height_moment_ - ball_height_moment_);
  }
  /// Gravity now.
  void look(const StateVector& x) noexcept;
  template <int kDim>
  void correct(const Eigen::Vector2d& tilt_W, double variance,
               BasicInformationFilter<kDim>& filter) noexcept;

  ReducedDynamics dynamics_;
  BalanceSettings settings_;
  double ball_height_moment_;  ///< total mass times radius of the ball [kg m]
  bool hand_known_ = true;
  bool begun_ = false;
  bool pushed_ = false;                                  ///< in the last window
  double elapsed_ = 0;                                   ///< of the window [s]
  Eigen::Vector2d momentum_ = Eigen::Vector2d::Zero();   ///< at the begin of the window [kg m^2/s]
  Eigen::Vector2d explained_ = Eigen::Vector2d::Zero();  ///< its change so far [kg m^2/s]
  Eigen::Vector2d moment_ = Eigen::Vector2d::Zero();     ///< of gravity, at the last step [N m]
  double height_moment_ = 0;                             ///< at the last step [kg m]
};

}  // namespace ballbot
