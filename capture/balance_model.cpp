#include "capture/balance_model.hpp"

#include <cmath>

#include <Eigen/Dense>

#include "controller/rigid_arm.hpp"
#include "model/frames.hpp"
#include "model/reduced_dynamics.hpp"
#include "model/wheel_loads.hpp"

namespace ballbot {
namespace {

constexpr int kMoving = kVelocityDim - kArmJointCount;  // velocities that are not the arm's
constexpr int kAngles[] = {kPitch, kRoll};  // rows of x that stand in s before the rates

/// Rows of x that make up s.
int rowOfState(int i) {
  return i < BalanceModel::kRates ? kAngles[i] : kPositionDim + i - BalanceModel::kRates;
}

/// Normal forces and tractions about rest, by differences.
void findWheelForces(const ReducedDynamics& dynamics, const Equilibrium& rest, BalanceModel& m) {
  const WheelLoadModel loads(dynamics.robot());
  const auto at = [&](const BalanceModel::State& s, const Vector3& u, const Eigen::Vector2d& f) {
    StateVector x = rest.x;
    for (int i = 0; i < BalanceModel::kStates; ++i) x[rowOfState(i)] += s[i];
    JointVector tau = rest.tau;
    tau.head<kWheelCount>() += u;
    VelocityVector dnu =
        dynamics.acceleration(x.head<kPositionDim>(), x.tail<kVelocityDim>(), tau, Vector3::Zero());
    dnu.head<kMoving>() += m.E.bottomRows<kMoving>() * f;
    return loads.at(x, dnu, tau.head<kWheelCount>(), {f.x(), f.y(), 0});
  };
  using State = BalanceModel::State;
  const State s = State::Zero();
  const Vector3 u = Vector3::Zero();
  const Eigen::Vector2d f = Eigen::Vector2d::Zero();
  const WheelLoads at_rest = at(s, u, f);
  m.normal_force.at_rest = at_rest.normal;
  m.traction.at_rest = at_rest.traction;
  constexpr double h = 1e-5;
  const auto slope = [&](const WheelLoads& above, const WheelLoads& below, int column,
                         auto BalanceModel::OfWheels::*by) {
    (m.normal_force.*by).col(column) = (above.normal - below.normal) / (2 * h);
    (m.traction.*by).col(column) = (above.traction - below.traction) / (2 * h);
  };
  for (int i = 0; i < BalanceModel::kStates; ++i) {
    const State d = h * State::Unit(i);
    slope(at(d, u, f), at(-d, u, f), i, &BalanceModel::OfWheels::by_state);
  }
  for (int i = 0; i < kWheelCount; ++i) {
    const Vector3 d = h * Vector3::Unit(i);
    slope(at(s, d, f), at(s, -d, f), i, &BalanceModel::OfWheels::by_torque);
  }
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d d = h * Eigen::Vector2d::Unit(i);
    slope(at(s, u, d), at(s, u, -d), i, &BalanceModel::OfWheels::by_force);
  }
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

BalanceModel BalanceModel::of(const RobotParameters& robot, const ArmVector& arm,
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

  findWheelForces(dynamics, rest, m);
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
