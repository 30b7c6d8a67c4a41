#include "hil/identify/figures.hpp"

#include <cmath>
#include <stdexcept>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr int kAll = static_cast<int>(kBalanceCount) + static_cast<int>(kLoopCount);
using AllVector = Eigen::Matrix<double, kAll, 1>;
using AllMatrix = Eigen::Matrix<double, kAll, kAll>;

const char* const kNoCurrent = "the drive shows no motor current";
const char* const kNotTurned = "needs back-driven records";

/// A figure as a function of all that was fitted.
struct Definition {
  const char *name, *unit, *key;
  int index;     ///< of what is fitted; -1: the bandwidth
  double scale;  ///< to the unit
};
constexpr int kDerived = -1;
const Definition kDefinitions[] = {
    {"stiffness", "Nm/rad", "stiffness_Nm_per_rad", kStiffness, 1},
    {"rotor inertia", "kg m^2", "rotor_inertia_kgm2", kRotorInertia, 1},
    {"viscous friction", "Nms/rad", "viscous_friction_Nms_per_rad", kViscous, 1},
    {"Coulomb friction", "Nm", "coulomb_friction_Nm", kCoulomb, 1},
    {"load-dependent friction", "Nm/Nm", "load_friction", kLoadFriction, 1},
    {"backlash", "deg", "backlash_deg", kBacklash, kDegPerRad},
    {"spring damping", "Nms/rad", "spring_damping_Nms_per_rad", kSpringDamping, 1},
    {"delay", "ms", "delay_ms", static_cast<int>(kBalanceCount) + static_cast<int>(kDelay), 1e3},
    {"bandwidth", "Hz", "bandwidth_Hz", kDerived, 1},
};

double bandwidthOf(const AllVector& x, double k0) {
  return DriveLoop(x.head<kBalanceCount>(), x.tail<kLoopCount>(), k0).bandwidth_Hz();
}

AllMatrix covarianceOf(const BalanceFit& balance, const LoopFit& loop) {
  const auto& S = loop.sensitivity;
  AllMatrix C;
  C.topLeftCorner<kBalanceCount, kBalanceCount>() = balance.covariance;
  C.bottomLeftCorner<kLoopCount, kBalanceCount>() = S * balance.covariance;
  C.topRightCorner<kBalanceCount, kLoopCount>() = balance.covariance * S.transpose();
  C.bottomRightCorner<kLoopCount, kLoopCount>() =
      loop.covariance + S * balance.covariance * S.transpose();
  return C;
}

AllVector bandwidthSlope(const AllVector& x, const AllMatrix& C, double k0) {
  AllVector slope;
  for (int i = 0; i < kAll; ++i) {
    const double step = std::max(1e-9, 0.1 * std::sqrt(C(i, i)));
    AllVector up = x, down = x;
    up[i] += step;
    down[i] -= step;
    slope[i] = (bandwidthOf(up, k0) - bandwidthOf(down, k0)) / (2 * step);
  }
  return slope;
}

}  // namespace

const Figure& Figures::at(const std::string& key) const {
  for (const Figure& f : list) {
    if (f.key == key) return f;
  }
  throw std::out_of_range("no figure " + key);
}

Figures figuresOf(const BalanceFit& balance, const LoopFit& loop, double k0, bool back_driven) {
  AllVector x;
  x << balance.value, loop.value;
  const AllMatrix C = covarianceOf(balance, loop);
  Figures out;
  std::vector<AllVector> slopes;
  for (const Definition& d : kDefinitions) {
    Figure f{d.name, d.unit, d.key};
    AllVector slope = AllVector::Zero();
    if (d.index == kDerived) {
      f.value = bandwidthOf(x, k0);
      slope = bandwidthSlope(x, C, k0);
    } else {
      f.value = d.scale * x[d.index];
      slope[d.index] = d.scale;
    }
    f.sigma = std::sqrt(slope.dot(C * slope));
    f.identified = d.index != kLoadFriction || back_driven;
    if (f.identified) {
      slopes.push_back(slope / f.sigma);
    } else {
      f.why = kNotTurned;
    }
    out.list.push_back(f);
  }
  const auto n = static_cast<int>(slopes.size());
  out.correlation.resize(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      out.correlation(i, j) =
          slopes[static_cast<std::size_t>(i)].dot(C * slopes[static_cast<std::size_t>(j)]);
    }
  }
  return out;
}

Figures figuresOf(const TorqueResponse& r) {
  Figures out;
  for (const Definition& d : kDefinitions) {
    Figure f{d.name, d.unit, d.key};
    f.why = kNoCurrent;
    out.list.push_back(f);
  }
  const auto set = [&](const char* key, double value, double sigma) {
    for (Figure& f : out.list) {
      if (f.key != key) continue;
      f.value = value;
      f.sigma = sigma;
      f.identified = true;
      f.why.clear();
    }
  };
  set("delay_ms", 1e3 * r.delay, 1e3 * r.delay_sigma);
  set("bandwidth_Hz", r.bandwidth_Hz(), r.bandwidth_sigma_Hz());
  out.correlation = Eigen::Matrix2d::Identity();
  out.correlation(0, 1) = out.correlation(1, 0) = r.bandwidth_delay_correlation();
  return out;
}

}  // namespace ballbot
