#include "controller/torque_loop.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "core/angle.hpp"
#include "core/config_reader.hpp"

namespace ballbot {
namespace {

using Complex = std::complex<double>;

constexpr double kLowestHz = 0.05, kHighestHz = 500;
constexpr int kPerDecade = 200;

/// Rates of (x, deflection, rotor rate, motor torque) with series elastic drives at all joints:
/// docs/theory/actuator.md, eq. 1, 2, 5, friction linear.
void addDrives(const LoopDrives& drives, const SelectionMatrix& S, Eigen::MatrixXd& A,
               Eigen::MatrixXd& B) {
  constexpr int kX = kStateDim, kDeflection = kX, kRate = kX + kJointCount,
                kMotor = kRate + kJointCount;
  Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(kMotor + kJointCount, kMotor + kJointCount);
  Eigen::MatrixXd inputs = Eigen::MatrixXd::Zero(rates.rows(), kJointCount);
  rates.topLeftCorner(kX, kX) = A;
  for (int j = 0; j < kJointCount; ++j) {
    const ActuatorParameters& p = drives.actuators.of(j);
    const double k = p.spring_stiffness, b = p.spring_damping, J = p.reflectedInertia();
    Eigen::RowVectorXd deflection_rate = Eigen::RowVectorXd::Zero(rates.cols());
    deflection_rate[kRate + j] = 1;
    deflection_rate.segment<kVelocityDim>(kPositionDim) = -S.row(j);
    Eigen::RowVectorXd spring = b * deflection_rate;
    spring[kDeflection + j] += k;

    rates.topRows(kX) += B.col(j) * spring;
    rates.row(kDeflection + j) = deflection_rate;
    rates.row(kRate + j) = -spring / J;
    rates(kRate + j, kRate + j) -= p.viscous_friction / J;
    rates(kRate + j, kMotor + j) = 1 / J;
    // The drive's sample and hold counts as lag: both are short beside what a loop has to follow.
    const double lag = 1 / (2 * kPi * p.current_loop_bandwidth) + drives.drive_period / 2;
    rates.row(kMotor + j) = -p.torqueGainD() * k / lag * deflection_rate;
    rates(kMotor + j, kDeflection + j) = -p.torqueGainP() * k / lag;
    rates(kMotor + j, kMotor + j) = -1 / lag;
    inputs(kMotor + j, j) = (1 + p.torqueGainP()) / lag;
  }
  A = rates;
  B = inputs;
}

// Of any size on purpose: the eigenvalue solver for each fixed size costs the compiler half a
// minute.
Eigen::VectorXcd lociOf(const Eigen::MatrixXcd& L) { return L.eigenvalues(); }

/// Gain of the largest locus (eigenvalue) of a loop.
double largestGain(const Eigen::MatrixXcd& L) { return lociOf(L).cwiseAbs().maxCoeff(); }

/// Frequency between `low` and `high` at which `above_one` changes.
template <typename Function>
double bisect(double low, double high, const Function& above_one) {
  const bool at_low = above_one(low);
  for (int i = 0; i < 50; ++i) {
    const double middle = std::sqrt(low * high);
    (above_one(middle) == at_low ? low : high) = middle;
  }
  return low;
}

}  // namespace

TorqueLoop::TorqueLoop(const ShapedLqr& law, const ReducedDynamics& dynamics,
                       const std::optional<LoopDrives>& drives, double delay)
    : law_(law), delay_(delay), A_(law.model.df_dx), B_(law.model.df_dtau) {
  if (drives) {
    addDrives(*drives, dynamics.selectionMatrix(law.equilibrium.x.head<kPositionDim>()), A_, B_);
  }
}

TorqueLoop::Joints TorqueLoop::joints(double omega) const {
  const Complex s(0, omega);
  const auto n = A_.rows();
  const Eigen::MatrixXcd resolvent_B = (s * Eigen::MatrixXcd::Identity(n, n) - A_.cast<Complex>())
                                           .partialPivLu()
                                           .solve(B_.cast<Complex>());
  // The law: u = -K_x x - K_f x_f, x_f = pole / (s + pole) u_wheels.
  Joints filtered = Joints::Identity();
  filtered.leftCols<kFilterDim>() += law_.K.rightCols<kFilterDim>().cast<Complex>() *
                                     (law_.shaping.pole / (s + law_.shaping.pole));
  const Joints feedback =
      law_.K.leftCols<kStateDim>().cast<Complex>() * resolvent_B.topRows<kStateDim>();
  return std::exp(-s * delay_) * filtered.partialPivLu().solve(feedback);
}

TorqueLoop::Wheels TorqueLoop::wheels(double omega) const {
  // The wheels' block of the sensitivity is that of the loop with the arm closed.
  const Joints sensitivity = (Joints::Identity() + joints(omega)).inverse();
  return Wheels(sensitivity.topLeftCorner<kWheelCount, kWheelCount>()).inverse() -
         Wheels::Identity();
}

double TorqueLoop::slowestPoleWithoutDelay() const {
  const auto n = A_.rows();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(kJointCount, n + kFilterDim);
  K.leftCols(kStateDim) = law_.K.leftCols<kStateDim>();
  K.rightCols(kFilterDim) = law_.K.rightCols<kFilterDim>();
  Eigen::MatrixXd closed = Eigen::MatrixXd::Zero(n + kFilterDim, n + kFilterDim);
  closed.topLeftCorner(n, n) = A_;
  closed.topRows(n) -= B_ * K;
  closed.bottomRows(kFilterDim) = -law_.shaping.pole * K.topRows(kFilterDim);
  closed.bottomRightCorner(kFilterDim, kFilterDim) -=
      law_.shaping.pole * Eigen::Matrix3d::Identity();
  return closed.eigenvalues().real().maxCoeff();
}

std::vector<double> loopFrequencies() {
  const double decades = std::log10(kHighestHz / kLowestHz);
  const int count = static_cast<int>(std::lround(decades * kPerDecade)) + 1;
  std::vector<double> omega;
  for (int i = 0; i < count; ++i) {
    omega.push_back(2 * kPi * kLowestHz * std::pow(10.0, decades * i / (count - 1)));
  }
  return omega;
}

LoopShape shapeOf(const TorqueLoop& loop) {
  const std::vector<double> omega = loopFrequencies();
  LoopShape out;
  out.distance = kInf;
  double last_above = 0;
  for (const double w : omega) {
    const TorqueLoop::Wheels L = loop.wheels(w);
    if (largestGain(L) > 1) last_above = w;
    const double distance =
        (TorqueLoop::Wheels::Identity() + L).jacobiSvd().singularValues()[kWheelCount - 1];
    if (distance < out.distance) {
      out.distance = distance;
      out.distance_at = w;
    }
  }
  const auto next = std::upper_bound(omega.begin(), omega.end(), last_above);
  if (last_above > 0 && next != omega.end()) {
    out.crossover =
        bisect(last_above, *next, [&](double w) { return largestGain(loop.wheels(w)) > 1; });
  }
  return out;
}

}  // namespace ballbot
