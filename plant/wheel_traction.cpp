#include "plant/wheel_traction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A wheel sticks, carries nothing, or slides: at the torque that friction gives it, or at that of
/// a fault where this is less.
struct Hold {
  enum Kind { kSticks, kSlides, kSlidesAtLimit, kLifted } kind = kSticks;
  double sign = 0;  ///< of the torque of a wheel that slides
};
using Holds = std::array<Hold, kWheelCount>;

/// Most that a wheel can carry at the normal force `N` [N m].
double carried(const TractionProblem& p, int wheel, double N) {
  return std::min(p.limit[wheel],
                  p.friction_lever < kInfinity ? p.friction_lever * std::max(N, 0.0) : kInfinity);
}

Vector3 solveAs(const Holds& holds, const TractionProblem& p) {
  Matrix3 M;
  Vector3 rhs;
  for (int i = 0; i < kWheelCount; ++i) {
    const Hold& hold = holds[static_cast<std::size_t>(i)];
    if (hold.kind == Hold::kSticks) {
      M.row(i) = p.A.row(i);
      rhs[i] = p.wanted[i];
      if (p.canSlip(i)) {
        M(i, i) += p.creep / p.fade_s;
        rhs[i] -= p.slip[i] / p.fade_s;
      }
      continue;
    }
    M.row(i) = Vector3::Unit(i).transpose();
    rhs[i] = hold.kind == Hold::kSlidesAtLimit ? hold.sign * p.limit[i] : 0;
    if (hold.kind == Hold::kSlides) {
      M.row(i) -= hold.sign * p.friction_lever * p.N_torque.row(i);
      rhs[i] = hold.sign * p.friction_lever * p.N_free[i];
    }
  }
  return M.partialPivLu().solve(rhs);
}

/// Of a wheel that contradicts what it is taken to do: what it does instead, and by how much.
struct Correction {
  int wheel = -1;
  double size = 0;
  Hold hold;
};

Correction worst(const Holds& holds, const TractionProblem& p, const Vector3& lambda) {
  const Vector3 N = p.normalForce(lambda);
  Correction out;
  for (int i = 0; i < kWheelCount; ++i) {
    if (!p.canSlip(i)) continue;
    const auto consider = [&](double size, Hold hold) {
      if (size > out.size) out = {i, size, hold};
    };
    const Hold& now = holds[static_cast<std::size_t>(i)];
    const bool frictional = p.friction_lever < kInfinity;
    const double weight = frictional ? p.friction_lever * N[i] : kInfinity;
    switch (now.kind) {
      case Hold::kSticks: {
        const bool at_limit = p.limit[i] < weight;
        consider(std::abs(lambda[i]) - carried(p, i, N[i]),
                 {at_limit ? Hold::kSlidesAtLimit : Hold::kSlides, lambda[i] > 0 ? 1.0 : -1.0});
        break;
      }
      case Hold::kSlides:
        consider(-weight, {Hold::kLifted, 0});
        consider(weight - p.limit[i], {Hold::kSlidesAtLimit, now.sign});
        break;
      case Hold::kSlidesAtLimit:
        if (frictional) consider(p.limit[i] - weight, {Hold::kSlides, now.sign});
        break;
      case Hold::kLifted:
        consider(weight, {});
        break;
    }
  }
  return out;
}

}  // namespace

void WheelContactParameters::describe(ConfigVisitor& v) {
  v.number(may("friction",
               "largest force along a wheel's direction of driving per normal force; without it "
               "robot.wheels.friction"),
           friction, {1e-3, 10});
  v.number(may("creep_m_per_s_per_N", "slip velocity of a wheel per such force, below the largest"),
           creep, {0, 1e-3});
  v.boolean(may("recorded", "normal force and traction go on record where wheels roll, too"),
            recorded);
}

bool TractionProblem::canSlip(int wheel) const {
  return friction_lever < kInfinity || limit[wheel] < kInfinity;
}

Vector3 solveTraction(const TractionProblem& p) {
  Holds holds{};
  Vector3 lambda = solveAs(holds, p);
  // Each wheel may slide, lift and touch again; more would go round in circles.
  for (int pass = 0; pass < 4 * kWheelCount; ++pass) {
    const Correction next = worst(holds, p, lambda);
    if (next.wheel < 0) break;
    holds[static_cast<std::size_t>(next.wheel)] = next.hold;
    lambda = solveAs(holds, p);
  }
  // Where no answer was found in so many, none carries more than it can.
  const Vector3 N = p.normalForce(lambda);
  for (int i = 0; i < kWheelCount; ++i) {
    if (!p.canSlip(i)) continue;
    const double most = carried(p, i, N[i]);
    lambda[i] = std::clamp(lambda[i], -most, most);
  }
  return lambda;
}

}  // namespace ballbot
