#include "estimator/balance_aiding.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/config_visitor.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

/// Arm rates are taken over so long: encoders count in steps, and a rate over one period is mostly
/// these [ns].
constexpr SimDuration kRateSpan{10'000'000};

StateVector wholeBodyState(const FilterState& x, SimTime time, const JointHistory& joints) {
  StateVector out = StateVector::Zero();
  const Vector3 ypr = yawPitchRollFromRotation(x.R_WB);
  out.segment<3>(kYaw) = ypr;
  out.segment<2>(kPositionDim) = x.v_WK_W;
  out.segment<3>(kPositionDim + kOmegaX) = x.w_WB_B;
  if (joints.empty()) return out;
  const ArmVector arm = joints.at(time).tail<kArmJointCount>();
  const SimTime before = std::max(time - kRateSpan, joints.oldestTime());
  out.segment<kArmJointCount>(kArm1) = arm;
  if (before < time) {
    out.tail<kArmJointCount>() =
        (arm - joints.at(before).tail<kArmJointCount>()) / toSeconds(time - before);
  }
  return out;
}

}  // namespace

void BalanceSettings::describe(ConfigVisitor& v) {
  v.boolean(may("enabled", "whether the way the robot falls corrects the tilt"), enabled);
  v.number(may("momentum_kg_m2_per_s",
               "how well the change of angular momentum over a window is measured"),
           momentum_sigma, {1e-4, 100});
  v.number(may("moment_Nm", "what the model does not know of gravity's moment about the contact"),
           moment_sigma, {1e-3, 100});
  v.number(may("window_s", "length of a window over which the change is taken"), window_s,
           {0.01, 10});
  v.number(may("push_chi_square", "a window above it is a push, and the tilt is not to blame"),
           push_chi_square, {2, 1e12});
}

BalanceAiding::BalanceAiding(const RobotParameters& robot, const BalanceSettings& settings)
    : dynamics_(robot),
      settings_(settings),
      ball_height_moment_(robot.totalMass() * robot.ball.radius) {}

void BalanceAiding::setHand(double mass, bool known) noexcept {
  hand_known_ = known;
  if (mass == dynamics_.robot().payload_mass) return;
  dynamics_.setPayload(mass);
  ball_height_moment_ = dynamics_.robot().totalMass() * dynamics_.robot().ball.radius;
}

void BalanceAiding::look(const StateVector& x) noexcept {
  const GravityAboutContact gravity = gravityAboutContact(dynamics_, x.head<kPositionDim>());
  moment_ = gravity.moment_W;
  height_moment_ = gravity.height_moment;
}

template <int kDim>
void BalanceAiding::step(double h, SimTime time, const JointHistory& joints,
                         BasicInformationFilter<kDim>& filter) noexcept {
  if (!settings_.enabled) return;
  if (!hand_known_) {
    interrupt();
    return;
  }
  StateVector x = wholeBodyState(filter.state(), time, joints);
  const Eigen::Vector2d moment_before = moment_;
  const double height_before = height_moment_;
  look(x);
  if (begun_) {
    const Eigen::Vector2d& v = filter.state().v_WK_W;
    const double rise = height_moment_ - height_before;  // of m z_C; v_K x m v_C has no more
    explained_ +=
        0.5 * h * (moment_before + moment_) - Eigen::Vector2d(v.y() * rise, -v.x() * rise);
    elapsed_ += h;
  }
  if (begun_ && elapsed_ < settings_.window_s - h / 2) return;

  if (begun_) {
    const double stiffness = tiltStiffness();
    const Eigen::Vector2d unexplained =
        (contactMomentum(dynamics_, x) - momentum_ - explained_) / elapsed_;
    const double sigma = std::sqrt(2.0) * settings_.momentum_sigma / elapsed_ / stiffness;
    correct(unexplained / stiffness, sigma * sigma, filter);
    x = wholeBodyState(filter.state(), time, joints);
    look(x);
  }
  begun_ = true;
  elapsed_ = 0;
  momentum_ = contactMomentum(dynamics_, x);
  explained_.setZero();
}

template <int kDim>
void BalanceAiding::correct(const Eigen::Vector2d& tilt_W, double variance,
                            BasicInformationFilter<kDim>& filter) noexcept {
  const Matrix3& R = filter.state().R_WB;
  const Eigen::Matrix<double, 2, 3> tilt_by_attitude = R.topRows<2>();
  const Eigen::Matrix2d P = tilt_by_attitude *
                            filter.covariance().template block<3, 3>(kTanAttitude, kTanAttitude) *
                            tilt_by_attitude.transpose();
  const double floor = std::pow(settings_.moment_sigma / tiltStiffness(), 2);
  Eigen::Matrix2d S = P;
  S.diagonal().array() += variance + floor;
  const bool pushed_before = pushed_;
  pushed_ = tilt_W.dot(S.inverse() * tilt_W) > settings_.push_chi_square;
  if (pushed_ || pushed_before) return;

  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(P);
  Eigen::Matrix<double, 3, kTangentDim> H = Eigen::Matrix<double, 3, kTangentDim>::Zero();
  Vector3 y = Vector3::Zero();
  for (int i = 0; i < 2; ++i) {
    const double allowed = 1 / floor - 1 / std::max(axes.eigenvalues()[i], 1e-12);
    if (allowed <= 0) continue;
    const double root = std::sqrt(std::min(allowed, 1 / variance));
    const Eigen::Vector2d u = axes.eigenvectors().col(i);
    H.block<1, 3>(i, kTanAttitude) = root * u.transpose() * tilt_by_attitude;
    y[i] = -root * u.dot(tilt_W);
  }
  if (!H.isZero(0)) filter.addRows(H, y);
}

template void BalanceAiding::step(double, SimTime, const JointHistory&,
                                  BasicInformationFilter<kTangentDim>&) noexcept;
template void BalanceAiding::step(double, SimTime, const JointHistory&,
                                  BasicInformationFilter<kSpinTangentDim>&) noexcept;

}  // namespace ballbot
