#include "hil/identify/momentum_balance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/angle.hpp"

namespace ballbot {
namespace {

using Weights = std::vector<double>;
constexpr double kFlankSigmas = 3;
constexpr int kFewestClear = 200;  // equations away from the flanks

/// Hann window over 2 half + 1 samples, of unit sum.
Weights lowPass(int half) {
  Weights w(static_cast<std::size_t>(2 * half + 1));
  double sum = 0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    w[i] = 0.5 * (1 - std::cos(kTwoPi * static_cast<double>(i + 1) / (2.0 * half + 2)));
    sum += w[i];
  }
  for (double& x : w) x /= sum;
  return w;
}

Weights convolved(const Weights& a, const Weights& b) {
  Weights c(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  }
  return c;
}

/// Sum of weights times samples from `first` on.
double weighted(const Weights& w, const std::vector<double>& x, int first) {
  double sum = 0;
  for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] * x[static_cast<std::size_t>(first) + i];
  return sum;
}

double signOf(double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; }

}  // namespace

std::vector<double> rateOf(const std::vector<double>& x, double period) {
  std::vector<double> rate(x.size());
  for (std::size_t n = 2; n + 2 < x.size(); ++n) {
    rate[n] = (8 * (x[n + 1] - x[n - 1]) - (x[n + 2] - x[n - 2])) / (12 * period);
  }
  return rate;
}

// Also for a negative backlash, to which a fit may come where there is none: the spring is then
// stiffer around its zero, and dz stays smooth in it.
BalanceTerms balanceTerms(const BalanceVector& p, double sign, double deflection, double rate,
                          double velocity) {
  const double half = 0.5 * p[kBacklash], k = p[kStiffness];
  const bool touches = std::abs(deflection) > std::abs(half);
  const double sat = touches ? signOf(deflection) : half == 0 ? 0 : deflection / std::abs(half);
  const double z = deflection - half * sat;
  const double dz_deflection = touches ? 1 : half < 0 ? 2 : 0;
  const double engaged = touches ? 1 : 0;
  BalanceTerms t;
  t.spring = k * z + p[kSpringDamping] * rate * engaged;
  t.dry_friction = (p[kCoulomb] + p[kLoadFriction] * std::abs(t.spring)) * sign;
  const double share =
      1 + p[kLoadFriction] * signOf(t.spring) * sign;  // of a change of the spring's
  t.slope[kStiffness] = share * z;
  t.slope[kSpringDamping] = share * rate * engaged;
  t.slope[kViscous] = velocity;
  t.slope[kCoulomb] = sign;
  t.slope[kLoadFriction] = std::abs(t.spring) * sign;
  t.slope[kBacklash] = touches ? -0.5 * share * k * sat : 0;
  t.zero_slope = -share * k * dz_deflection;
  return t;
}

MomentumBalance::MomentumBalance(const Record& record, double least_speed, int half_width)
    : record_(&record),
      velocity_(rateOf(record.motor_angle, record.period)),
      inner_weights_(convolved({1.0 / 12, 10.0 / 12, 1.0 / 12}, lowPass(half_width))),
      torque_weights_(
          convolved({-1.0 / 24, 13.0 / 24, 13.0 / 24, -1.0 / 24}, lowPass(half_width))) {
  deflection_ = record.deflection();
  rate_ = rateOf(deflection_, record.period);
  const double T = record.period;
  const Weights second = convolved({1 / (T * T), -2 / (T * T), 1 / (T * T)}, lowPass(half_width));
  const int reach = half_width + 1;  // of the inner weights
  int same = 0;                      // samples in a row, in one direction and fast
  for (int n = 2; n + 2 < record.size(); ++n) {
    const double v = velocity_[static_cast<std::size_t>(n)];
    const double before = velocity_[static_cast<std::size_t>(n - 1)];
    same = std::abs(v) < least_speed ? 0 : v * before > 0 ? same + 1 : 1;
    const int centre = n - reach;
    if (same < 2 * reach + 1 || centre - reach - 1 < 0) continue;
    centres_.push_back(centre);
    acceleration_.push_back(weighted(second, record.motor_angle, centre - reach));
  }
  weighTorque();
}

void MomentumBalance::weighTorque() {
  std::vector<double> torque = record_->motor_torque;
  for (std::size_t n = 0; n < excess_.size(); ++n) torque[n] -= excess_[n];
  const int reach = static_cast<int>(torque_weights_.size()) / 2 - 1;
  torque_.clear();
  for (const int centre : centres_) {
    torque_.push_back(weighted(torque_weights_, torque, centre - reach));
  }
}

void MomentumBalance::correctTorque(const std::vector<double>& excess) {
  excess_ = excess;
  weighTorque();
}

// Second differences of a slow deflection are those of its noise, six times the variance.
double MomentumBalance::deflectionNoise() const {
  double sum = 0;
  for (std::size_t n = 1; n + 1 < deflection_.size(); ++n) {
    sum += std::pow(deflection_[n - 1] - 2 * deflection_[n] + deflection_[n + 1], 2);
  }
  return std::sqrt(sum / (6 * static_cast<double>(deflection_.size())));
}

void MomentumBalance::leaveOutFlanks(double zero, double backlash) {
  const double width = 0.5 * std::abs(backlash) + kFlankSigmas * deflectionNoise();
  const int reach = static_cast<int>(inner_weights_.size()) / 2;
  std::vector<int> centres;
  std::vector<double> acceleration;
  for (std::size_t i = 0; i < centres_.size(); ++i) {
    bool clear = true;
    for (int n = centres_[i] - reach; n <= centres_[i] + reach; ++n) {
      clear = clear && std::abs(deflection_[static_cast<std::size_t>(n)] - zero) > width;
    }
    if (!clear) continue;
    centres.push_back(centres_[i]);
    acceleration.push_back(acceleration_[i]);
  }
  if (static_cast<int>(centres.size()) < kFewestClear) return;
  centres_ = centres;
  acceleration_ = acceleration;
  weighTorque();
}

MomentumBalance::Prediction MomentumBalance::predict(const BalanceVector& p, double zero) const {
  const auto count = static_cast<Eigen::Index>(deflection_.size());
  Eigen::Matrix<double, kBalanceCount + 1, Eigen::Dynamic> slopes(kBalanceCount + 1, count);
  Eigen::VectorXd torques(count);
  for (Eigen::Index n = 0; n < count; ++n) {
    const auto i = static_cast<std::size_t>(n);
    const BalanceTerms t =
        balanceTerms(p, signOf(velocity_[i]), deflection_[i] - zero, rate_[i], velocity_[i]);
    torques[n] = t.spring + p[kViscous] * velocity_[i] + t.dry_friction;
    slopes.col(n) << t.slope, t.zero_slope;
  }
  const auto taps = static_cast<Eigen::Index>(inner_weights_.size());
  const Eigen::Map<const Eigen::VectorXd> weights(inner_weights_.data(), taps);
  Prediction out;
  out.torque.resize(size());
  out.slope.resize(kBalanceCount + 1, size());
  for (int i = 0; i < size(); ++i) {
    const double acceleration = acceleration_[static_cast<std::size_t>(i)];
    const Eigen::Index first = sample(i) - taps / 2;
    out.torque[i] = p[kRotorInertia] * acceleration + torques.segment(first, taps).dot(weights);
    out.slope.col(i).noalias() = slopes.middleCols(first, taps) * weights;
    out.slope(kRotorInertia, i) = acceleration;
  }
  return out;
}

Eigen::VectorXd MomentumBalance::residuals(const Prediction& prediction) const {
  return Eigen::Map<const Eigen::VectorXd>(torque_.data(), size()) - prediction.torque;
}

double MomentumBalance::meanDeflection() const {
  double sum = 0;
  for (const double d : deflection_) sum += d;
  return deflection_.empty() ? 0 : sum / static_cast<double>(deflection_.size());
}

}  // namespace ballbot
