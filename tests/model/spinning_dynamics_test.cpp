#include "model/spinning_dynamics.hpp"

#include <complex>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "model/newton_euler.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

constexpr int kCases = 100;

/// A random case with a spin of the ball, a torque of the floor and a moment on the end-effector.
struct SpinningCase {
  explicit SpinningCase(int index) : held(randomCase(index)) {
    const auto u = RandomStream(43, "spinning_dynamics_test").uniforms(index, 0);
    x << held.x, 12 * u[0] - 6;
    floor = 4 * u[1] - 2;
    moment = Vector3(held.lambda.y(), -held.lambda.x(), 0.5 * held.lambda.z());
  }
  PositionVector q() const { return x.head<kPositionDim>(); }
  SpinningVelocityVector nu() const { return x.tail<kSpinningVelocityDim>(); }

  RandomCase held;
  SpinningStateVector x;
  double floor;
  Vector3 moment;
};

class SpinningDynamicsTest : public ::testing::Test {
 protected:
  RobotParameters robot = exampleRobot();
  ReducedDynamics held{robot};
  SpinningDynamics dynamics{robot};
};

TEST_F(SpinningDynamicsTest, TheMassMatrixIsPositiveDefiniteAndHoldsThatOfTheHeldBall) {
  for (int i = 0; i < kCases; ++i) {
    const SpinningCase c(i);
    const SpinningMassMatrix M = dynamics.massMatrix(c.q());
    EXPECT_EQ(M, M.transpose());
    EXPECT_EQ(M.llt().info(), Eigen::Success) << "case " << i;
    const MassMatrix corner = M.topLeftCorner<8, 8>();
    EXPECT_LT((corner - held.massMatrix(c.q())).norm(), 1e-13 * corner.norm());
  }
}

TEST_F(SpinningDynamicsTest, AccelerationSolvesTheEquationsOfMotion) {
  for (int i = 0; i < kCases; ++i) {
    const SpinningCase c(i);
    const SpinningVelocityVector dnu =
        dynamics.acceleration(c.q(), c.nu(), c.held.tau, c.held.lambda, c.floor);
    SpinningVelocityVector residual = dynamics.massMatrix(c.q()) * dnu +
                                      dynamics.nonlinearEffects(c.q(), c.nu()) -
                                      dynamics.selectionMatrix(c.q()).transpose() * c.held.tau;
    residual.head<kVelocityDim>() -=
        held.endEffectorJacobian(c.q()).topRows<3>().transpose() * c.held.lambda;
    residual[kBallSpin] -= c.floor;
    EXPECT_LT(residual.norm(), 1e-11) << "case " << i;
  }
}

TEST_F(SpinningDynamicsTest, EnergyChangesByThePowerThatComesIn) {
  for (int i = 0; i < kCases; ++i) {
    const SpinningCase c(i);
    const SpinningStateVector dx =
        dynamics.derivative(c.x, c.held.tau, c.held.lambda, c.floor, &c.moment);
    const auto slope = [&](double h) {
      return (dynamics.energy(c.x + h * dx) - dynamics.energy(c.x - h * dx)) / (2 * h);
    };
    const double step = 1e-4, energy_rate = (4 * slope(step / 2) - slope(step)) / 3;
    const auto tip = held.endEffector(c.held.x);
    const JointVector rates = dynamics.selectionMatrix(c.q()) * c.nu();
    const double power = c.held.tau.dot(rates) + c.held.lambda.dot(tip.v_WE_W) +
                         c.moment.dot(tip.w_WE_W) + c.floor * c.x[kPositionDim + kBallSpin];
    EXPECT_NEAR(energy_rate, power, 1e-7 * (1 + std::abs(power))) << "case " << i;
  }
}

TEST_F(SpinningDynamicsTest, EnergyStaysWhereNothingActs) {
  const SpinningCase c(3);
  SpinningStateVector x = c.x;
  x.tail<kSpinningVelocityDim>() *= 0.3;
  const double start = dynamics.energy(x), spin = x[kPositionDim + kBallSpin], h = 1e-3;
  const auto f = [&](const SpinningStateVector& at) {
    return dynamics.derivative(at, JointVector::Zero(), Vector3::Zero(), 0);
  };
  for (int k = 0; k < 500; ++k) {
    const SpinningStateVector k1 = f(x), k2 = f(x + h / 2 * k1), k3 = f(x + h / 2 * k2);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + f(x + h * k3));
  }
  EXPECT_NEAR(dynamics.energy(x), start, 1e-7 * start);
  EXPECT_GT(std::abs(x[kPositionDim + kBallSpin] - spin), 0.01) << "the wheels turn the ball";
}

// The eight-velocity model is this one on a floor that returns whatever it takes.
TEST_F(SpinningDynamicsTest, HeldByTheFloorItMovesAsWithoutSpin) {
  for (int i = 0; i < kCases; ++i) {
    SpinningCase c(i);
    c.x[kPositionDim + kBallSpin] = 0;
    const double floor = dynamics.floorSpinTorque(c.held.x, c.held.tau, c.held.lambda, &c.moment);
    const auto expected = held.derivative(c.held.x, c.held.tau, c.held.lambda, &c.moment);
    const SpinningStateVector got =
        dynamics.derivative(c.x, c.held.tau, c.held.lambda, floor, &c.moment);
    EXPECT_LT((got.head<kStateDim>() - expected).norm(), 1e-11 * expected.norm()) << "case " << i;
    EXPECT_LT(std::abs(got[kPositionDim + kBallSpin]), 1e-10 * expected.norm());
  }
}

// r(q, nu, dnu) = M dnu + h - S^T tau - J_E^T (lambda, moment) - e floor by the complex step, which
// takes no difference.
TEST_F(SpinningDynamicsTest, DerivativesAgreeWithTheComplexStep) {
  using Complex = std::complex<double>;
  using Pass = NewtonEuler<Complex, true>;
  const DynamicsConstants constants(robot);
  for (int k = 0; k < kCases; ++k) {
    const SpinningCase c(k);
    SpinningDynamics::Linearization lin;
    dynamics.linearize(c.x, c.held.tau, c.held.lambda, c.floor, lin, &c.moment);
    const SpinningVelocityVector dnu = lin.f.tail<kSpinningVelocityDim>();
    Eigen::Matrix<double, kSpinningVelocityDim, kSpinningStateDim> residual;
    for (int i = 0; i < kSpinningStateDim; ++i) {
      Eigen::Matrix<Complex, kSpinningStateDim, 1> z = c.x.cast<Complex>();
      z[i] += Complex(0, 1e-40);
      const Pass pass(constants, z.head<kPositionDim>(), z.tail<kSpinningVelocityDim>());
      Pass::Velocities force =
          pass.appliedForce(c.held.tau.cast<Complex>(), c.held.lambda.cast<Complex>());
      pass.addMoment(c.moment.cast<Complex>(), force);
      const Pass::Velocities r =
          pass.massMatrix() * dnu.cast<Complex>() + pass.nonlinearEffects() - force;
      residual.col(i) = r.imag() / 1e-40;
    }
    const auto error =
        (dynamics.massMatrix(c.q()) * lin.df_dx.bottomRows<kSpinningVelocityDim>() + residual)
            .eval();
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-12 * (1 + residual.cwiseAbs().maxCoeff()))
        << "case " << k;
  }
}

TEST_F(SpinningDynamicsTest, ValueAndDerivativesAgreeWithDifferences) {
  for (int k = 0; k < 20; ++k) {
    const SpinningCase c(k);
    SpinningDynamics::Linearization lin;
    dynamics.linearize(c.x, c.held.tau, c.held.lambda, c.floor, lin, &c.moment);
    const auto f = [&](const SpinningStateVector& x, const JointVector& tau, double floor) {
      return dynamics.derivative(x, tau, c.held.lambda, floor, &c.moment);
    };
    const SpinningStateVector at = f(c.x, c.held.tau, c.floor);
    const double scale = 1 + lin.df_dx.cwiseAbs().maxCoeff();
    EXPECT_LT((lin.f - at).norm(), 1e-12 * (1 + at.norm()));
    const double h = 1e-5;
    for (int i = 0; i < kSpinningStateDim; ++i) {
      const SpinningStateVector step = h * SpinningStateVector::Unit(i);
      const SpinningStateVector slope =
          (f(c.x + step, c.held.tau, c.floor) - f(c.x - step, c.held.tau, c.floor)) / (2 * h);
      EXPECT_LT((lin.df_dx.col(i) - slope).norm(), 1e-6 * scale) << "case " << k << ", " << i;
    }
    // Affine in the inputs: a unit step is exact.
    for (int i = 0; i < kJointCount; ++i) {
      const SpinningStateVector step = f(c.x, c.held.tau + JointVector::Unit(i), c.floor) - at;
      EXPECT_LT((lin.df_dtau.col(i) - step).norm(), 1e-11 * (1 + at.norm()));
    }
    const SpinningStateVector by_floor = f(c.x, c.held.tau, c.floor + 1) - at;
    EXPECT_LT((lin.df_dfloor - by_floor).norm(), 1e-11 * (1 + at.norm()));
    for (int i = 0; i < 3; ++i) {
      const Vector3 unit = Vector3::Unit(i), more = c.moment + unit;
      EXPECT_LT(
          (lin.df_dlambda.col(i) -
           (dynamics.derivative(c.x, c.held.tau, c.held.lambda + unit, c.floor, &c.moment) - at))
              .norm(),
          1e-11 * (1 + at.norm()));
      EXPECT_LT((lin.df_dmoment.col(i) -
                 (dynamics.derivative(c.x, c.held.tau, c.held.lambda, c.floor, &more) - at))
                    .norm(),
                1e-11 * (1 + at.norm()));
    }
  }
}

TEST_F(SpinningDynamicsTest, ARigidArmDoesNotMove) {
  RobotParameters rigid = robot;
  for (ArmLink& link : rigid.arm) link.inertia = {};
  rigid.payload_mass = 0;
  const SpinningDynamics arm(rigid);
  const SpinningCase c(1);
  const SpinningVelocityVector dnu =
      arm.acceleration(c.q(), c.nu(), c.held.tau, c.held.lambda, c.floor);
  EXPECT_EQ((dnu.segment<kArmJointCount>(kArmRate1)), Vector3::Zero());
  EXPECT_TRUE(dnu.allFinite());
}

}  // namespace
}  // namespace ballbot
