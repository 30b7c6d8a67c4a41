#include <complex>

#include <gtest/gtest.h>

#include "model/newton_euler.hpp"
#include "tests/model/robot_fixture.hpp"
#include "tests/model/sliding_robot.hpp"

namespace ballbot {
namespace {

constexpr int kCases = 100;

/// A moment on the end-effector to go with a case [N m].
Vector3 momentOf(const RandomCase& c) { return {c.lambda.y(), -c.lambda.x(), 0.5 * c.lambda.z()}; }

/// Partial derivatives of the residual M dnu + h - S^T tau - J_E^T (lambda, moment) by x, with dnu
/// held, by the complex step: exact to rounding, because no difference is taken.
Eigen::Matrix<double, 8, 16> residualByComplexStep(const DynamicsConstants& constants,
                                                   const RandomCase& c,
                                                   const VelocityVector& acceleration) {
  using Complex = std::complex<double>;
  using Pass = NewtonEuler<Complex>;
  const double step = 1e-40;
  const Pass::Vec6 tau = c.tau.cast<Complex>();
  const Pass::Vec3 lambda = c.lambda.cast<Complex>();
  const Pass::Vec3 moment = momentOf(c).cast<Complex>();
  Eigen::Matrix<double, 8, 16> derivative;
  for (int i = 0; i < kStateDim; ++i) {
    Eigen::Matrix<Complex, kStateDim, 1> z = c.x.cast<Complex>();
    z[i] += Complex(0, step);
    const Pass pass(constants, z.head<8>(), z.tail<8>());
    Pass::Vec8 force = pass.appliedForce(tau, lambda);
    pass.addMoment(moment, force);
    const Pass::Vec8 residual =
        pass.massMatrix() * acceleration.cast<Complex>() + pass.nonlinearEffects() - force;
    derivative.col(i) = residual.imag() / step;
  }
  return derivative;
}

TEST(DynamicsDerivatives, AgreeWithTheComplexStep) {
  for (const RobotParameters& shape : {exampleRobot(), withASlide(exampleRobot())}) {
    const RobotParameters robot = shape;
    const ReducedDynamics dynamics(robot);
    const DynamicsConstants constants(robot);
    for (int k = 0; k < kCases; ++k) {
      const RandomCase c = randomCase(k);
      ReducedDynamics::Linearization lin;
      const Vector3 moment = momentOf(c);
      dynamics.linearize(c.x, c.tau, c.lambda, lin, &moment);
      const auto residual = residualByComplexStep(constants, c, lin.f.tail<8>());
      const MassMatrix M = dynamics.massMatrix(c.x.head<8>());
      const Eigen::Matrix<double, 8, 16> error = M * lin.df_dx.bottomRows<8>() + residual;
      EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-12 * (1 + residual.cwiseAbs().maxCoeff()))
          << "case " << k;
    }
  }
}

// Central differences, extrapolated twice (Richardson): error of order h^6.
TEST(DynamicsDerivatives, AgreeWithExtrapolatedDifferences) {
  for (const RobotParameters& shape : {exampleRobot(), withASlide(exampleRobot())}) {
    const ReducedDynamics dynamics(shape);
    for (int k = 0; k < kCases; ++k) {
      const RandomCase c = randomCase(k);
      ReducedDynamics::Linearization lin;
      dynamics.linearize(c.x, c.tau, c.lambda, lin);
      const double scale = 1 + lin.df_dx.cwiseAbs().maxCoeff();

      const StateVector f = dynamics.derivative(c.x, c.tau, c.lambda);
      EXPECT_LT((lin.f - f).norm(), 1e-12 * (1 + f.norm()));
      for (int i = 0; i < kStateDim; ++i) {
        const auto slope = [&](double h) -> StateVector {
          StateVector plus = c.x, minus = c.x;
          plus[i] += h;
          minus[i] -= h;
          return (dynamics.derivative(plus, c.tau, c.lambda) -
                  dynamics.derivative(minus, c.tau, c.lambda)) /
                 (2 * h);
        };
        const double h = 8e-3;
        const StateVector d1 = slope(h), d2 = slope(h / 2), d4 = slope(h / 4);
        const StateVector once = (4 * d2 - d1) / 3, twice = (4 * d4 - d2) / 3;
        const StateVector expected = (16 * twice - once) / 15;
        EXPECT_LT((lin.df_dx.col(i) - expected).norm(), 1e-9 * scale)
            << "case " << k << " column " << i;
      }
    }
  }
}

// The acceleration is affine in torque and force: a unit step is exact.
TEST(DynamicsDerivatives, AgreeWithUnitStepsOfTheInputs) {
  const ReducedDynamics dynamics(exampleRobot());
  for (int k = 0; k < kCases; ++k) {
    const RandomCase c = randomCase(k);
    ReducedDynamics::Linearization lin;
    dynamics.linearize(c.x, c.tau, c.lambda, lin);
    for (int i = 0; i < kJointCount; ++i) {
      const StateVector expected =
          dynamics.derivative(c.x, c.tau + JointVector::Unit(i), c.lambda) - lin.f;
      EXPECT_LT((lin.df_dtau.col(i) - expected).norm(), 1e-11 * (1 + lin.f.norm()));
    }
    for (int i = 0; i < 3; ++i) {
      const StateVector expected =
          dynamics.derivative(c.x, c.tau, c.lambda + Vector3::Unit(i)) - lin.f;
      EXPECT_LT((lin.df_dlambda.col(i) - expected).norm(), 1e-11 * (1 + lin.f.norm()));
    }
    const Vector3 moment = momentOf(c);
    dynamics.linearize(c.x, c.tau, c.lambda, lin, &moment);
    EXPECT_LT((lin.f - dynamics.derivative(c.x, c.tau, c.lambda, &moment)).norm(),
              1e-12 * (1 + lin.f.norm()));
    for (int i = 0; i < 3; ++i) {
      const Vector3 more = moment + Vector3::Unit(i);
      const StateVector expected = dynamics.derivative(c.x, c.tau, c.lambda, &more) - lin.f;
      EXPECT_LT((lin.df_dmoment.col(i) - expected).norm(), 1e-11 * (1 + lin.f.norm()));
    }
  }
}

TEST(DynamicsDerivatives, AMomentGivesThePowerOfItsTurning) {
  for (const RobotParameters& shape : {exampleRobot(), withASlide(exampleRobot())}) {
    const ReducedDynamics dynamics(shape);
    for (int k = 0; k < 20; ++k) {
      const RandomCase c = randomCase(k);
      const Vector3 moment = momentOf(c);
      const StateVector with = dynamics.derivative(c.x, c.tau, c.lambda, &moment);
      const StateVector without = dynamics.derivative(c.x, c.tau, c.lambda);
      const VelocityVector nu = c.x.tail<kVelocityDim>();
      const double power =
          nu.dot(dynamics.massMatrix(c.x.head<8>()) * (with - without).tail<kVelocityDim>());
      EXPECT_NEAR(power, moment.dot(dynamics.endEffector(c.x).w_WE_W), 1e-10);
    }
  }
}

}  // namespace
}  // namespace ballbot
