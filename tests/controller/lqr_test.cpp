#include "controller/lqr.hpp"

#include <cmath>
#include <complex>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gmock/gmock.h>

#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "solver/riccati_equation.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/solver/support/eigenvalues.hpp"

namespace ballbot {
namespace {

using Eigen::MatrixXd;
using testing::HasSubstr;

struct LinearModel {
  StateJacobian A;
  TorqueJacobian B;
};

LinearModel linearAt(const ReducedDynamics& dynamics, const Equilibrium& equilibrium) {
  ReducedDynamics::Linearization model;
  dynamics.linearize(equilibrium.x, equilibrium.tau, Vector3::Zero(), model);
  return {model.df_dx, model.df_dtau};
}

double largestRealPart(const MatrixXd& A) {
  return eigenvaluesOf(A).real().maxCoeff();
}

/// The closed loop with every torque behind a second-order lag of natural frequency `f_Hz` and a
/// delay, the latter as a second-order Pade approximation.
double largestRealPartBehindDrives(const LinearModel& m, const FeedbackGain& K, double f_Hz,
                                   double delay_s) {
  const double w = 2 * M_PI * f_Hz, zeta = 0.707, T = delay_s;
  // Per actuator: Pade states (p1, p2), lag states (torque, rate).
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  // Pade: y = u - 12/T p2 with p1' = p2, p2' = -12/T^2 p1 - 6/T p2 + u.
  a(0, 1) = 1;
  a(1, 0) = -12 / (T * T);
  a(1, 1) = -6 / T;
  b[1] = 1;
  a(2, 3) = 1;
  a(3, 2) = -w * w;
  a(3, 3) = -2 * zeta * w;
  a(3, 1) = -w * w * 12 / T;
  b[3] = w * w;
  const int n = kStateDim + 4 * kJointCount;
  MatrixXd whole = MatrixXd::Zero(n, n);
  whole.topLeftCorner(kStateDim, kStateDim) = m.A;
  for (int i = 0; i < kJointCount; ++i) {
    const int at = kStateDim + 4 * i;
    whole.block(at, at, 4, 4) = a;
    whole.block(at, 0, 4, kStateDim) = b * K.row(i);
    whole.block(0, at + 2, kStateDim, 1) = m.B.col(i);
  }
  return largestRealPart(whole);
}

class Lqr : public testing::Test {
 protected:
  RobotParameters robot_ = exampleRobot();
  ReducedDynamics dynamics_{robot_};
  LqrWeights weights_;
  LqrSolution lqr_ = designLqr(dynamics_, robot_.nominal_arm, weights_);
  LinearModel model_ = linearAt(dynamics_, lqr_.equilibrium);
};

TEST_F(Lqr, StabilisesWhatIsUnstableWithoutIt) {
  EXPECT_GT(largestRealPart(model_.A), 4);
  EXPECT_LT(largestRealPart(model_.A + model_.B * lqr_.K), -0.5);
}

TEST_F(Lqr, ItsValueIsTheCostThatTheClosedLoopRunsUp) {
  // Lyapunov: d/dt (x' P x) = -x' (Q + K' R K) x along the closed loop.
  const StateJacobian closed = model_.A + model_.B * lqr_.K;
  const StateJacobian decay = closed.transpose() * lqr_.P + lqr_.P * closed;
  const StateJacobian cost =
      weights_.stateWeight() + lqr_.K.transpose() * weights_.torqueWeight().asDiagonal() * lqr_.K;
  EXPECT_LT((decay + cost).cwiseAbs().maxCoeff(), 1e-8 * cost.cwiseAbs().maxCoeff());
}

TEST_F(Lqr, HoldsItsEquilibriumWithoutMotion) {
  const StateVector rate =
      dynamics_.derivative(lqr_.equilibrium.x, lqr_.equilibrium.tau, Vector3::Zero());
  EXPECT_LT(rate.cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(Lqr, StaysStableBehindTheDrivesTorqueLoops) {
  // What it must live with (40 Hz, 1 ms) and what it must survive (12 Hz, 5 ms).
  EXPECT_LT(largestRealPartBehindDrives(model_, lqr_.K, 40, 1e-3), -0.5);
  EXPECT_LT(largestRealPartBehindDrives(model_, lqr_.K, 12, 5e-3), -0.1);
}

TEST_F(Lqr, KeepsItsDistanceFromTheCriticalPointAtEveryWheel) {
  // One wheel's loop broken between command and drive: |1 + L| >= 1/2 means gain margin above 2 and
  // phase margin above 29 degrees, with a 40 Hz drive and 1 ms of delay in the loop.
  const std::complex<double> j(0, 1);
  for (int wheel = 0; wheel < kWheelCount; ++wheel) {
    double nearest = 1e9;
    for (double w = 0.1; w < 2000; w *= 1.02) {
      const std::complex<double> s = j * w;
      const double wa = 2 * M_PI * 40;
      const std::complex<double> drive =
          wa * wa / (s * s + 2 * 0.707 * wa * s + wa * wa) * std::exp(-s * 1e-3);
      // The other five loops are closed through their drives.
      Eigen::MatrixXcd A = model_.A.cast<std::complex<double>>();
      for (int i = 0; i < kJointCount; ++i)
        if (i != wheel) A += drive * model_.B.col(i) * lqr_.K.row(i);
      const Eigen::MatrixXcd sI = s * Eigen::MatrixXcd::Identity(kStateDim, kStateDim);
      const Eigen::VectorXcd response =
          (sI - A).partialPivLu().solve(model_.B.col(wheel).cast<std::complex<double>>());
      const std::complex<double> L = -drive * (lqr_.K.row(wheel) * response)(0);
      nearest = std::min(nearest, std::abs(1.0 + L));
    }
    EXPECT_GT(nearest, 0.5) << "wheel " << wheel + 1;
  }
}

TEST_F(Lqr, TurningTheWorldTurnsNothingInTheJoints) {
  const double yaw = 2.3;
  const Matrix3 Rz = Eigen::AngleAxisd(yaw, Vector3::UnitZ()).toRotationMatrix();
  StateVector error = StateVector::LinSpaced(-1, 1);
  StateVector turned = error;
  for (int at : {0, kPositionDim})
    turned.segment<2>(at) = Rz.topLeftCorner<2, 2>() * error.segment<2>(at);
  const JointVector straight = lqr_.K * error;
  EXPECT_LT((gainAtYaw(lqr_.K, yaw) * turned - straight).norm(), 1e-12 * straight.norm());
}

TEST_F(Lqr, RefusesAnArmPoseWithoutEquilibrium) {
  RobotParameters heavy = robot_;
  heavy.payload_mass = 60;
  EXPECT_THROW(designLqr(ReducedDynamics(heavy), Vector3(0, 1.5, 0), weights_), NumericalError);
}

TEST(LqrWeights, ATorqueMustCostSomething) {
  const ConfigNode tree = parseYaml("{wheel_torque: 0}", "lqr.yaml");
  ConfigReader in(tree);
  try {
    LqrWeights weights;
    readDescribed(in, weights);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("wheel_torque is 0, must be more than 0"));
  }
}

}  // namespace
}  // namespace ballbot
