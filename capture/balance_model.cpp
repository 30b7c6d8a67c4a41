#include "capture/balance_model.hpp"

#include <cmath>

#include <Eigen/Dense>

#include "controller/rigid_arm.hpp"
#include "model/frames.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {
namespace {

constexpr int kMoving = kVelocityDim - kArmJointCount;  // velocities that are not the arm's
constexpr int kAngles[] = {kPitch, kRoll};  // rows of x that stand in s before the rates

/// Rows of x that make up s.
int rowOfState(int i) {
  return i < BalanceModel::kRates ? kAngles[i] : kPositionDim + i - BalanceModel::kRates;
}

/// e^X by Taylor's series of X / 2^k, squared k times. X / 2^k is so small that the terms left out
/// are below the last digit.
template <int N>
Eigen::Matrix<double, N, N> exponential(const Eigen::Matrix<double, N, N>& X) {
  using Matrix = Eigen::Matrix<double, N, N>;
  constexpr int kTerms = 18;
  const double size = X.cwiseAbs().rowwise().sum().maxCoeff();
  const int k = size > 0.5 ? static_cast<int>(std::ceil(std::log2(size / 0.5))) : 0;
  const Matrix Y = X / std::exp2(k);
  Matrix sum = Matrix::Identity(), term = Matrix::Identity();
  for (int i = 1; i <= kTerms; ++i) {
    term = term * Y / i;
    sum += term;
  }
  for (int i = 0; i < k; ++i) sum = sum * sum;
  return sum;
}

}  // namespace

BalanceModel BalanceModel::of(const RobotParameters& robot, const Vector3& arm,
                              const Vector3& p_BP_B) {
  const ReducedDynamics dynamics(withRigidArm(robot, arm));
  const Equilibrium rest = findEquilibrium(dynamics, arm);
  const PositionVector q = rest.x.head<kPositionDim>();
  ReducedDynamics::Linearization at_rest;
  dynamics.linearize(rest.x, rest.tau, Vector3::Zero(), at_rest);

  BalanceModel m;
  for (int i = 0; i < kStates; ++i) {
    for (int j = 0; j < kStates; ++j) m.A(i, j) = at_rest.df_dx(rowOfState(i), rowOfState(j));
    m.B.row(i) = at_rest.df_dtau.row(rowOfState(i)).head<kWheelCount>();
  }

  // A force on P is J^T f on the velocities, with J from v_P = v_K + R (w x p).
  const Matrix3 R_WB = rotationFromYawPitchRoll(q[kYaw], q[kPitch], q[kRoll]);
  const auto velocityOf = [&](const Vector3& p) {
    Eigen::Matrix<double, 2, kMoving> J;
    J << Eigen::Matrix2d::Identity(), (-R_WB * skew(p)).topRows<2>();
    return J;
  };
  const Eigen::Matrix<double, kMoving, kMoving> M =
      dynamics.massMatrix(q).topLeftCorner<kMoving, kMoving>();
  m.E.setZero();
  m.E.bottomRows<kMoving>() = M.ldlt().solve(velocityOf(p_BP_B).transpose());

  m.wheel_rates.setZero();
  m.wheel_rates.rightCols<kMoving>() =
      dynamics.selectionMatrix(q).topLeftCorner<kWheelCount, kMoving>();

  const RobotParameters& rigid = dynamics.robot();
  const double upper_mass = rigid.totalMass() - rigid.ball.mass;
  m.momentum_rate.setZero();
  m.momentum_rate.rightCols<kMoving>() = upper_mass * velocityOf(rigid.baseWithWheels().p_LLcm_L);
  m.momentum_rate.block<2, 2>(0, kRates) += rigid.ball.mass * Eigen::Matrix2d::Identity();

  m.torque_at_rest = rest.tau.head<kWheelCount>();
  m.pitch_at_rest = q[kPitch];
  m.roll_at_rest = q[kRoll];
  m.weight = rigid.totalMass() * rigid.gravity;
  return m;
}

BalanceStep::BalanceStep(const BalanceModel& model, double duration_s) {
  constexpr int n = BalanceModel::kStates, inputs = kWheelCount + 2;
  Eigen::Matrix<double, n + inputs, n + inputs> X;
  X.setZero();
  X.topRows<n>() << model.A, model.B, model.E;
  const Eigen::Matrix<double, n + inputs, n + inputs> whole =
      exponential<n + inputs>(duration_s * X);
  A = whole.topLeftCorner<n, n>();
  B = whole.block<n, kWheelCount>(0, n);
  E = whole.block<n, 2>(0, n + kWheelCount);
}

}  // namespace ballbot
