#include "estimator/contact_force_observer.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/state_visitors.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

constexpr double kBandwidth = 25;
constexpr double kPeriod_s = 2.5e-3;
constexpr int kFineSteps = 5;

/// The reduced model in motion under a force on the end-effector and another on its base, with an
/// arm that its torques hold loosely; seen every 2.5 ms.
class ObservedRobot {
 public:
  ObservedRobot() : dynamics_(exampleRobot()), observer(exampleRobot(), kBandwidth) {
    const Equilibrium rest = findEquilibrium(dynamics_, dynamics_.robot().nominal_arm);
    x = rest.x;
    rest_ = rest;
  }
  void advance(const Vector3& force_W, double base_torque = 0) {
    const double h = kPeriod_s / kFineSteps;
    for (int n = 0; n < kFineSteps; ++n) {  // classical Runge-Kutta
      const StateVector k1 = rate(x, force_W, base_torque);
      const StateVector k2 = rate(x + 0.5 * h * k1, force_W, base_torque);
      const StateVector k3 = rate(x + 0.5 * h * k2, force_W, base_torque);
      const StateVector k4 = rate(x + h * k3, force_W, base_torque);
      x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    time_ += durationFromSeconds(kPeriod_s);
    observer.update(time_, x, torqueAt(x));
  }

  StateVector x;

 private:
  JointVector torqueAt(const StateVector& at) const {
    JointVector tau = rest_.tau;
    const Vector3 error = at.segment<3>(kArm1) - rest_.x.segment<3>(kArm1);
    tau.tail<3>() -= 20 * error + 2 * at.tail<3>();
    return tau;
  }
  /// A push on the base that no sensor of the arm feels, as a generalised force on pitch.
  StateVector rate(const StateVector& at, const Vector3& force_W, double base_torque) const {
    StateVector out = dynamics_.derivative(at, torqueAt(at), force_W);
    VelocityVector push = VelocityVector::Zero();
    push[kOmegaY] = base_torque;
    out.tail<kVelocityDim>() += dynamics_.massMatrix(at.head<kPositionDim>()).ldlt().solve(push);
    return out;
  }

  ReducedDynamics dynamics_;
  Equilibrium rest_;
  SimTime time_ = kSimStart;

 public:
  ContactForceObserver observer;
};

TEST(ContactForceObserver, FollowsAForceAsAFirstOrderLag) {
  ObservedRobot robot;
  const Vector3 force(-5, 1, 2);
  for (int n = 0; n < 20; ++n) robot.advance(Vector3::Zero());
  EXPECT_LT(robot.observer.force().norm(), 1e-3);
  for (int n = 1; n <= 80; ++n) {
    robot.advance(force);
    const double share = 1 - std::exp(-kBandwidth * n * kPeriod_s);
    // The lag acts on the joints' rows, so while the arm moves a little is left between axes.
    EXPECT_LT((robot.observer.force() - share * force).norm(), 0.03 * force.norm()) << n;
  }
}

TEST(ContactForceObserver, DoesNotTakeAPushOnTheBaseForContact) {
  ObservedRobot robot;
  for (int n = 0; n < 60; ++n) robot.advance(Vector3::Zero(), 8);  // 8 N m tip the robot over
  EXPECT_GT(robot.x[kPositionDim + kOmegaY], 0.05);
  EXPECT_LT(robot.observer.force().norm(), 0.1);
}

TEST(ContactForceObserver, StartsAgainFromNothingAfterAReset) {
  ObservedRobot robot;
  for (int n = 0; n < 40; ++n) robot.advance({-5, 0, 0});
  EXPECT_GT(robot.observer.force().norm(), 3);
  robot.observer.reset();
  EXPECT_EQ(robot.observer.force(), Vector3::Zero());
}

TEST(ContactForceObserver, ContinuesFromASavedStateAndIgnoresWhatIsNotFinite) {
  ObservedRobot a;
  for (int n = 0; n < 20; ++n) a.advance({-5, 0, 0});
  ObservedRobot b = a;
  b.observer = ContactForceObserver(exampleRobot(), kBandwidth);
  restoreStateOf(b.observer, saveStateOf(a.observer, "test", 1), "test", 1);
  StateVector bad = b.x;
  bad[3] = std::nan("");
  b.observer.update(kSimStart + durationFromSeconds(1), bad, JointVector::Zero());
  for (int n = 0; n < 10; ++n) {
    a.advance({-5, 0, 0});
    b.advance({-5, 0, 0});
    EXPECT_EQ(a.observer.force(), b.observer.force());
  }
}

}  // namespace
}  // namespace ballbot
