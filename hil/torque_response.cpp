#include "hil/torque_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

using Complex = std::complex<double>;
constexpr int kAliases = 40;  // a second order has fallen by 1e-4 there
constexpr int kIterations = 60;
constexpr double kStep = 1e-6;

// The parameters in units in which all are about one: log w, D, T over the period.
using Vector = std::array<double, 3>;

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

/// The parameters that are fitted: w, T of the first order; w, D, T of the second.
struct Free {
  explicit Free(int order) : count(order == 1 ? 2 : 3) {
    if (order == 1) column = {0, 2, 2};
  }
  std::size_t size() const { return static_cast<std::size_t>(count); }
  int count;
  std::array<std::size_t, 3> column{0, 1, 2};
};

/// Normal equations of a step, the right side in the last column.
using Normal = std::array<std::array<double, 4>, 3>;

Normal normalEquations(const std::vector<ResponsePoint>& points, const Vector& v, int order,
                       double period) {
  const Free free(order);
  const TorqueResponse here = fromVector(v, order, period);
  Normal normal{};
  for (const ResponsePoint& p : points) {
    const Complex model = here.sampledAt(p.frequency_Hz, period);
    const Complex error = p.value - model;
    std::array<Complex, 3> slope;
    for (std::size_t i = 0; i < free.size(); ++i) {
      Vector moved = v;
      moved[free.column[i]] += kStep;
      slope[i] =
          (fromVector(moved, order, period).sampledAt(p.frequency_Hz, period) - model) / kStep;
    }
    for (std::size_t i = 0; i < free.size(); ++i) {
      for (std::size_t j = 0; j < free.size(); ++j) {
        normal[i][j] += std::real(std::conj(slope[i]) * slope[j]);
      }
      normal[i][3] += std::real(std::conj(slope[i]) * error);
    }
  }
  return normal;
}

/// Solves the first `n` of them; false if singular.
bool solve(Normal a, int n, Vector& x) {
  for (int i = 0; i < n; ++i) {
    int pivot = i;
    for (int r = i + 1; r < n; ++r) {
      if (std::abs(a[static_cast<std::size_t>(r)][static_cast<std::size_t>(i)]) >
          std::abs(a[static_cast<std::size_t>(pivot)][static_cast<std::size_t>(i)])) {
        pivot = r;
      }
    }
    std::swap(a[static_cast<std::size_t>(i)], a[static_cast<std::size_t>(pivot)]);
    auto& row = a[static_cast<std::size_t>(i)];
    if (std::abs(row[static_cast<std::size_t>(i)]) < 1e-14) return false;
    for (int r = 0; r < n; ++r) {
      if (r == i) continue;
      auto& other = a[static_cast<std::size_t>(r)];
      const double f = other[static_cast<std::size_t>(i)] / row[static_cast<std::size_t>(i)];
      for (std::size_t c = 0; c < 4; ++c) other[c] -= f * row[c];
    }
  }
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    x[k] = a[k][3] / a[k][k];
  }
  return true;
}

/// Standard deviations: residual variance times the inverse of the normal matrix, by columns.
Vector deviations(const Normal& normal, const Free& free, double variance) {
  Vector sigma{};
  for (std::size_t i = 0; i < free.size(); ++i) {
    Normal unit = normal;
    for (std::size_t r = 0; r < 3; ++r) unit[r][3] = r == i ? 1 : 0;
    Vector column{};
    if (solve(unit, free.count, column)) {
      sigma[free.column[i]] = std::sqrt(std::abs(variance * column[i]));
    }
  }
  return sigma;
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

TorqueResponse fitTorqueResponse(const std::vector<ResponsePoint>& points, int order,
                                 double period) {
  const Free free(order);
  if (static_cast<int>(points.size()) < free.count) {
    throw NumericalError(fmt::format("{} points do not determine a response", points.size()));
  }
  Vector v{std::log(kTwoPi * 0.1 / period), 0.7, 0.1};
  double cost = costOf(points, fromVector(v, order, period), period);
  double damping = 1e-3;  // Levenberg and Marquardt's
  Normal normal{};
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    normal = normalEquations(points, v, order, period);
    Normal damped = normal;
    for (std::size_t i = 0; i < free.size(); ++i) damped[i][i] *= 1 + damping;
    Vector step{};
    if (!solve(damped, free.count, step)) {
      throw NumericalError("the measured response determines no model");
    }
    Vector next = v;
    for (std::size_t i = 0; i < free.size(); ++i) next[free.column[i]] += step[i];
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
  TorqueResponse fitted = fromVector(v, order, period);
  const auto count = static_cast<double>(points.size());
  fitted.residual = std::sqrt(cost / count);
  const Vector sigma = deviations(normal, free, cost / std::max(1.0, 2 * count - free.count));
  fitted.natural_frequency_sigma = fitted.natural_frequency * sigma[0];
  fitted.damping_ratio_sigma = sigma[1];
  fitted.delay_sigma = period * sigma[2];
  return fitted;
}

}  // namespace ballbot
