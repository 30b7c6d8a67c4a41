#include "plant/wheel_traction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class Hold { kSticks, kSlidesUp, kSlidesDown, kLifted };
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
    if (holds[i] == Hold::kSticks) {
      M.row(i) = p.A.row(i);
      rhs[i] = p.wanted[i];
      if (p.canSlip(i)) {
        M(i, i) += p.creep / p.fade_s;
        rhs[i] -= p.slip[i] / p.fade_s;
      }
      continue;
    }
    M.row(i) = Vector3::Unit(i).transpose();
    rhs[i] = 0;
    if (holds[i] == Hold::kLifted) continue;
    const double sign = holds[i] == Hold::kSlidesUp ? 1 : -1;
    if (p.friction_lever < kInfinity) {
      M.row(i) -= sign * p.friction_lever * p.N_torque.row(i);
      rhs[i] = sign * p.friction_lever * p.N_free[i];
    } else {
      rhs[i] = sign * p.limit[i];
    }
  }
  return M.partialPivLu().solve(rhs);
}

/// Of a wheel that contradicts `holds`: what it does instead, and how far it is from what it does.
struct Correction {
  int wheel = -1;
  double size = 0;
  Hold hold = Hold::kSticks;
};

Correction worst(const Holds& holds, const TractionProblem& p, const Vector3& lambda) {
  const Vector3 N = p.normalForce(lambda);
  Correction out;
  const auto consider = [&out](int wheel, double size, Hold hold) {
    if (size > out.size) out = {wheel, size, hold};
  };
  for (int i = 0; i < kWheelCount; ++i) {
    if (!p.canSlip(i)) continue;
    const double weight = p.friction_lever < kInfinity ? p.friction_lever * N[i] : 0;
    if (holds[i] == Hold::kSticks) {
      consider(i, std::abs(lambda[i]) - carried(p, i, N[i]),
               lambda[i] > 0 ? Hold::kSlidesUp : Hold::kSlidesDown);
    } else if (holds[i] == Hold::kLifted) {
      consider(i, weight, Hold::kSticks);
    } else {
      consider(i, -weight, Hold::kLifted);
    }
  }
  return out;
}

}  // namespace

void WheelContactParameters::describe(ConfigVisitor& v) {
  v.number(may("friction",
               "largest force along a wheel's direction of driving per normal force; without it "
               "robot.wheels.friction"),
           friction, {0, 10});
  v.number(may("creep_m_per_s_per_N", "slip velocity of a wheel per such force, below the largest"),
           creep, {0, 1e-2});
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
  // A fault's limit on top of friction; rare, and then what the others carry is not asked again.
  for (int i = 0; i < kWheelCount; ++i) {
    lambda[i] = std::clamp(lambda[i], -p.limit[i], p.limit[i]);
  }
  return lambda;
}

}  // namespace ballbot
