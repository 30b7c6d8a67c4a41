#include "capture/push_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "capture/linear_program.hpp"
#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();
constexpr int kSides = 16;  // of the polygon around a circle; opposite ones share a row
constexpr int n = BalanceModel::kStates;

using Term = LinearProgram::Term;
using StateVariables = std::array<int, n>;

/// A stretch of time cut into equal steps.
struct Stretch {
  double duration_s;
  bool pushed, blind;
};

/// Nothing is longer than it has to be; where one ends another begins.
std::vector<Stretch> stretchesOf(const PushTimes& t) {
  std::vector<Stretch> out;
  const double blind = std::min(t.blind_s, t.duration_s + t.recovery_s);
  const auto add = [&](double from, double to, bool pushed, bool is_blind) {
    if (to > from) out.push_back({to - from, pushed, is_blind});
  };
  const double pushed_blind = std::min(blind, t.duration_s);
  add(0, pushed_blind, true, true);
  add(pushed_blind, t.duration_s, true, false);
  const double end = t.duration_s + t.recovery_s;
  add(t.duration_s, std::max(blind, t.duration_s), false, true);
  add(std::max(blind, t.duration_s), end, false, false);
  return out;
}

class PushProgram {
 public:
  PushProgram(const BalanceModel& model, const BalanceLimits& limits, double direction_rad)
      : model_(model),
        limits_(limits),
        direction_(std::cos(direction_rad), std::sin(direction_rad)),
        force_(program_.addVariable(0, kNoEnd)) {
    for (int& s : state_) s = program_.addVariable(0, 0);  // at rest
  }

  /// One step with torques of its own; none where it is blind.
  void addStep(const BalanceStep& step, const Stretch& stretch) {
    std::array<int, kWheelCount> torque;
    for (int w = 0; w < kWheelCount; ++w) {
      const double rest = model_.torque_at_rest[w];
      torque[w] = stretch.blind ? program_.addVariable(0, 0)
                                : program_.addVariable(-limits_.wheel_torque - rest,
                                                       limits_.wheel_torque - rest);
    }
    const double pushed = stretch.pushed ? 1 : 0;
    addFriction(torque, pushed);
    if (std::isfinite(limits_.wheel_friction)) addTraction(torque, pushed);
    StateVariables next;
    for (int& s : next) s = program_.addVariable(-kNoEnd, kNoEnd);
    const BalanceModel::State E = pushed * step.E * direction_;
    for (int i = 0; i < n; ++i) {
      std::vector<Term> row = {{next[i], -1}, {force_, E[i]}};
      for (int j = 0; j < n; ++j) row.push_back({state_[j], step.A(i, j)});
      for (int w = 0; w < kWheelCount; ++w) row.push_back({torque[w], step.B(i, w)});
      program_.addRow(0, 0, row);
    }
    state_ = next;
    addSpeedAndTilt();
  }

  double solve() {
    for (const int s : state_) program_.addRow(0, 0, {{s, 1}});
    return program_.largest(force_);
  }

 private:
  /// (x, y) no further than `radius` from (cx, cy), by the polygon around that circle.
  void addCircle(int x, int y, double radius, double cx, double cy) {
    if (!std::isfinite(radius)) return;
    for (int side = 0; side < kSides / 2; ++side) {
      const double angle = kTwoPi * side / kSides;
      const double c = std::cos(angle), s = std::sin(angle), middle = c * cx + s * cy;
      program_.addRow(middle - radius, middle + radius, {{x, c}, {y, s}});
    }
  }

  /// The floor's force on the ball, with the torques and the push at the beginning of a step.
  void addFriction(const std::array<int, kWheelCount>& torque, double pushed) {
    if (!std::isfinite(limits_.floor_friction)) return;
    const auto& G = model_.momentum_rate;
    const Eigen::Matrix<double, 2, n> by_state = G * model_.A;
    const Eigen::Matrix<double, 2, kWheelCount> by_torque = G * model_.B;
    const Eigen::Vector2d by_force = pushed * (G * model_.E * direction_ - direction_);
    std::array<int, 2> floor;
    for (int i = 0; i < 2; ++i) {
      floor[i] = program_.addVariable(-kNoEnd, kNoEnd);
      std::vector<Term> row = {{floor[i], -1}, {force_, by_force[i]}};
      for (int j = 0; j < n; ++j) row.push_back({state_[j], by_state(i, j)});
      for (int w = 0; w < kWheelCount; ++w) row.push_back({torque[w], by_torque(i, w)});
      program_.addRow(0, 0, row);
    }
    addCircle(floor[0], floor[1], limits_.floor_friction * model_.weight, 0, 0);
  }

  /// |traction| <= friction times normal force of each wheel, at the beginning of a step.
  void addTraction(const std::array<int, kWheelCount>& torque, double pushed) {
    const auto &normal = model_.normal_force, &traction = model_.traction;
    const double mu = limits_.wheel_friction;
    for (int wheel = 0; wheel < kWheelCount; ++wheel) {
      for (const double sign : {1.0, -1.0}) {
        // mu N - sign T >= 0
        const auto of = [&](const auto& of_normal, const auto& of_traction) {
          return mu * of_normal - sign * of_traction;
        };
        std::vector<Term> row;
        for (int j = 0; j < n; ++j) {
          row.push_back({state_[j], of(normal.by_state(wheel, j), traction.by_state(wheel, j))});
        }
        for (int w = 0; w < kWheelCount; ++w) {
          row.push_back({torque[w], of(normal.by_torque(wheel, w), traction.by_torque(wheel, w))});
        }
        row.push_back({force_, pushed * of(normal.by_force.row(wheel).dot(direction_),
                                           traction.by_force.row(wheel).dot(direction_))});
        program_.addRow(-of(normal.at_rest[wheel], traction.at_rest[wheel]), kNoEnd, row);
      }
    }
  }

  void addSpeedAndTilt() {
    for (int w = 0; w < kWheelCount && std::isfinite(limits_.wheel_speed); ++w) {
      std::vector<Term> row;
      for (int j = 0; j < n; ++j) row.push_back({state_[j], model_.wheel_rates(w, j)});
      program_.addRow(-limits_.wheel_speed, limits_.wheel_speed, row);
    }
    addCircle(state_[BalanceModel::kPitchRow], state_[BalanceModel::kRollRow], limits_.tilt,
              -model_.pitch_at_rest, -model_.roll_at_rest);
  }

  const BalanceModel& model_;
  const BalanceLimits limits_;
  const Eigen::Vector2d direction_;
  LinearProgram program_;
  int force_;
  StateVariables state_;
};

}  // namespace

double largestPush(const BalanceModel& model, const BalanceLimits& limits, const PushTimes& times,
                   double direction_rad) {
  PushProgram program(model, limits, direction_rad);
  for (const Stretch& stretch : stretchesOf(times)) {
    const int count =
        std::max(1, static_cast<int>(std::ceil(stretch.duration_s / times.step_s - 1e-9)));
    const BalanceStep step(model, stretch.duration_s / count);
    for (int i = 0; i < count; ++i) program.addStep(step, stretch);
  }
  return program.solve();
}

}  // namespace ballbot
