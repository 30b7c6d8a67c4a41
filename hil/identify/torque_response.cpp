#include "hil/identify/torque_response.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "hil/identify/spectrum.hpp"

namespace ballbot {
namespace {

constexpr int kAliases = 40;  // a second order has fallen by 1e-4 there
constexpr int kIterations = 60;
constexpr double kStep = 1e-6;

// The parameters in units in which all are about one: log w, D, T over the period.
using Vector = Eigen::Vector3d;

TorqueResponse fromVector(const Vector& v, int order, double period) {
  TorqueResponse r;
  r.order = order;
  r.natural_frequency = std::exp(v[0]);
  r.damping_ratio = v[1];
  r.delay = v[2] * period;
  return r;
}

double costOf(const std::vector<ResponsePoint>& points, const TorqueResponse& r, double period) {
  double sum = 0;
  for (const ResponsePoint& p : points)
    sum += std::norm(p.value - r.sampledAt(p.frequency_Hz, period));
  return sum;
}

/// Normal equations of a step: A step = g.
struct Normal {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
};

// What is not free has a unit diagonal and no step.
Normal normalEquations(const std::vector<ResponsePoint>& points, const Vector& v, int order,
                       double period) {
  const TorqueResponse here = fromVector(v, order, period);
  Normal normal;
  if (order == 1) normal.A(1, 1) = 1;
  for (const ResponsePoint& p : points) {
    const Complex model = here.sampledAt(p.frequency_Hz, period);
    Eigen::Vector3cd slope = Eigen::Vector3cd::Zero();
    for (int i = 0; i < 3; ++i) {
      if (order == 1 && i == 1) continue;
      Vector moved = v;
      moved[i] += kStep;
      slope[i] =
          (fromVector(moved, order, period).sampledAt(p.frequency_Hz, period) - model) / kStep;
    }
    normal.A += (slope.conjugate() * slope.transpose()).real();
    normal.g += (slope.conjugate() * (p.value - model)).real();
  }
  return normal;
}

/// How the logarithm of the bandwidth depends on log w and D.
Eigen::Vector3d bandwidthSlope(TorqueResponse r) {
  if (r.order == 1) return {1, 0, 0};
  const double here = std::log(r.bandwidth_Hz());
  r.damping_ratio += kStep;
  return {1, (std::log(r.bandwidth_Hz()) - here) / kStep, 0};
}

}  // namespace

Complex TorqueResponse::at(double frequency_Hz) const {
  const Complex s(0, kTwoPi * frequency_Hz);
  const double w = natural_frequency;
  const Complex lag =
      order == 1 ? w / (s + w) : w * w / (s * s + 2 * damping_ratio * w * s + w * w);
  return std::exp(-s * delay) * lag;
}

Complex TorqueResponse::sampledAt(double frequency_Hz, double period) const {
  const double sampling = 1 / period;
  Complex sum = 0;
  for (int k = -kAliases; k <= kAliases; ++k) {
    const double f = frequency_Hz + k * sampling;
    const double x = kTwoPi * f * period;
    // (1 - e^(-jx)) / (jx): the hold, unit gain at rest.
    const Complex hold =
        std::abs(x) < 1e-9 ? Complex(1) : (1.0 - std::exp(Complex(0, -x))) / Complex(0, x);
    sum += hold * at(f);
  }
  return sum;
}

double TorqueResponse::bandwidth_Hz() const {
  if (order == 1) return natural_frequency / kTwoPi;
  const double b = 1 - 2 * damping_ratio * damping_ratio;
  return natural_frequency * std::sqrt(b + std::sqrt(b * b + 1)) / kTwoPi;
}

double TorqueResponse::bandwidth_sigma_Hz() const {
  const Eigen::Vector3d slope = bandwidthSlope(*this);
  return bandwidth_Hz() * std::sqrt(slope.dot(covariance * slope));
}

double TorqueResponse::bandwidth_delay_correlation() const {
  const Eigen::Vector3d slope = bandwidthSlope(*this), with = covariance * slope;
  const double both = std::sqrt(slope.dot(with) * covariance(2, 2));
  return both > 0 ? with[2] / both : 0;
}

TorqueResponse fitTorqueResponse(const std::vector<ResponsePoint>& points, int order,
                                 double period) {
  const int unknowns = order == 1 ? 2 : 3;
  const int count = static_cast<int>(points.size());
  if (count < unknowns) {
    throw NumericalError(fmt::format("{} points do not determine a response", count));
  }
  Vector v(std::log(kTwoPi * 0.1 / period), 0.7, 0.1);
  double cost = costOf(points, fromVector(v, order, period), period);
  double damping = 1e-3;  // Levenberg and Marquardt's
  Normal normal;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    normal = normalEquations(points, v, order, period);
    Eigen::Matrix3d damped = normal.A;
    damped.diagonal() *= 1 + damping;
    const Vector next = v + damped.ldlt().solve(normal.g);
    const double next_cost = costOf(points, fromVector(next, order, period), period);
    if (next_cost < cost && next[1] > 0) {
      const bool settled = cost - next_cost < 1e-14 * (cost + 1e-12);
      v = next;
      cost = next_cost;
      damping *= 0.2;
      if (settled) break;
    } else {
      damping *= 8;
      if (damping > 1e9) break;
    }
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(normal.A);
  if (!lu.isInvertible() || !v.allFinite()) {
    throw NumericalError("the measured response determines no model");
  }
  TorqueResponse fitted = fromVector(v, order, period);
  fitted.residual = std::sqrt(cost / count);
  const double variance = cost / std::max(1, 2 * count - unknowns);
  fitted.covariance = variance * lu.inverse();
  if (order == 1) fitted.covariance(1, 1) = 0;
  fitted.covariance.row(2) *= period;
  fitted.covariance.col(2) *= period;
  const Eigen::Vector3d sigma = fitted.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  fitted.natural_frequency_sigma = fitted.natural_frequency * sigma[0];
  fitted.damping_ratio_sigma = sigma[1];
  fitted.delay_sigma = sigma[2];
  return fitted;
}

}  // namespace ballbot
