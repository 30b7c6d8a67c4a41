#include "tests/controller/support/continuous_margins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/angle.hpp"
#include "tests/solver/support/eigenvalues.hpp"

namespace ballbot {
namespace {

using Complex = std::complex<double>;

constexpr double kInf = std::numeric_limits<double>::infinity();

Eigen::VectorXcd lociOf(const Eigen::MatrixXcd& L) { return complexEigenvaluesOf(L); }

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

/// Gains of all loci, rising.
Eigen::VectorXd locusGains(const Eigen::MatrixXcd& L) {
  Eigen::VectorXd gains = lociOf(L).cwiseAbs();
  std::sort(gains.data(), gains.data() + gains.size());
  return gains;
}

/// Smallest delay of all its channels that turns a locus of `loop`, a function of omega, onto -1
/// [s].
template <typename Loop>
double smallestCriticalDelay(const Loop& loop, const std::vector<double>& omega) {
  double smallest = kInf;
  Eigen::VectorXd before;
  for (std::size_t n = 0; n < omega.size(); ++n) {
    const Eigen::VectorXd now = locusGains(loop(omega[n]));
    for (int i = 0; n > 0 && i < now.size(); ++i) {
      if ((now[i] > 1) == (before[i] > 1)) continue;
      const double w =
          bisect(omega[n - 1], omega[n], [&](double at) { return locusGains(loop(at))[i] > 1; });
      const Eigen::VectorXcd loci = lociOf(loop(w));
      for (int j = 0; j < loci.size(); ++j) {
        if (std::abs(std::abs(loci[j]) - 1) > 1e-6) continue;
        double lag = std::arg(loci[j]) + kPi;  // to -1, clockwise
        if (lag < 0) lag += 2 * kPi;
        smallest = std::min(smallest, lag / w);
      }
    }
    before = now;
  }
  return smallest;
}

using WheelLoci = Eigen::Matrix<Complex, kWheelCount, 1>;

/// `loci` in the order that brings each closest to its like in `before`.
WheelLoci inOrderOf(const WheelLoci& before, const WheelLoci& loci) {
  std::array<int, kWheelCount> order, best{};
  std::iota(order.begin(), order.end(), 0);
  double least = kInf;
  do {
    double sum = 0;
    for (int i = 0; i < kWheelCount; ++i) sum += std::abs(loci[order[i]] - before[i]);
    if (sum < least) {
      least = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  WheelLoci out;
  for (int i = 0; i < kWheelCount; ++i) out[i] = loci[best[i]];
  return out;
}

/// Where a locus crosses the negative real axis at -a, the gain 1 / a brings a pole to the
/// imaginary axis.
void findGainMargins(const TorqueLoop& loop, const std::vector<double>& omega,
                     ContinuousMargins& out) {
  out.wheel_gain_low = 0;
  out.wheel_gain_high = kInf;
  WheelLoci before = lociOf(loop.wheels(omega.front()));
  for (std::size_t n = 1; n < omega.size(); ++n) {
    const WheelLoci now = inOrderOf(before, lociOf(loop.wheels(omega[n])));
    for (int i = 0; i < kWheelCount; ++i) {
      const Complex a = before[i], b = now[i];
      if ((a.imag() > 0) == (b.imag() > 0)) continue;
      const double real = a.real() + (b.real() - a.real()) * a.imag() / (a.imag() - b.imag());
      if (real >= 0) continue;
      const double gain = -1 / real;
      (gain > 1 ? out.wheel_gain_high : out.wheel_gain_low) =
          gain > 1 ? std::min(out.wheel_gain_high, gain) : std::max(out.wheel_gain_low, gain);
    }
    before = now;
  }
}

}  // namespace

ContinuousMargins continuousMargins(const ShapedLqr& law, const ReducedDynamics& dynamics,
                                    const std::optional<LoopDrives>& drives, double delay) {
  const TorqueLoop loop(law, dynamics, drives, delay), prompt(law, dynamics, drives, 0);
  const std::vector<double> omega = loopFrequencies();
  ContinuousMargins out;
  const bool stable_at_once = prompt.slowestPoleWithoutDelay() < 0;
  const double critical =
      stable_at_once ? smallestCriticalDelay([&](double w) { return prompt.joints(w); }, omega) : 0;
  out.delay_margin = critical - delay;
  out.stable = stable_at_once && delay < critical;
  if (out.stable) {
    out.wheel_delay_margin = smallestCriticalDelay([&](double w) { return loop.wheels(w); }, omega);
    findGainMargins(loop, omega, out);
  }
  return out;
}

}  // namespace ballbot
