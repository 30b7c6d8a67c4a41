#include "metrics/ee_step_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <Eigen/Geometry>

#include "core/angle.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

constexpr const char* kNames[kPoseDim] = {"x", "y", "z", "yaw", "pitch", "roll"};
constexpr int kYawComponent = 3, kRollComponent = 5;
constexpr double kNoStep = 1e-12;  ///< [m or rad]

void keepWorst(std::map<std::string, double>& values, const std::string& name, double value) {
  const auto it = values.find(name);
  values[name] = it == values.end() ? value : std::max(it->second, value);
}

/// Each angle plus so many whole turns that it comes nearest to `goal`.
Vector3 nearestTurns(const Vector3& angles, const Vector3& goal) {
  Vector3 out;
  for (int i = 0; i < 3; ++i) out[i] = goal[i] + std::remainder(angles[i] - goal[i], kTwoPi);
  return out;
}

}  // namespace

PoseVector eePose(const TruthFrame& truth, const PoseVector& near) {
  const Eigen::Vector4d& q = truth.quat_WE;
  const Vector3 angles =
      yawPitchRollFromRotation(Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix());
  const Vector3 beyond(angles[0] + kPi, kPi - angles[1], angles[2] + kPi);  // the same attitude
  const Vector3 goal = near.tail<3>();
  const Vector3 a = nearestTurns(angles, goal), b = nearestTurns(beyond, goal);
  PoseVector pose;
  pose << truth.p_WE, (b - goal).squaredNorm() < (a - goal).squaredNorm() ? b : a;
  return pose;
}

EeStepMetrics::EeStepMetrics(std::vector<EeStep> steps, SimTime release, SimTime end)
    : release_(release) {
  std::map<SimTime, PoseVector> by_time;
  for (const EeStep& step : steps) {
    by_time.emplace(step.at, PoseVector::Zero()).first->second += step.by;
  }
  for (auto it = by_time.begin(); it != by_time.end(); ++it) {
    const auto next = std::next(it);
    const SimTime until = next == by_time.end() ? end : std::min(next->first, end);
    for (int i = 0; i < kPoseDim; ++i) {
      const bool angle = i >= kYawComponent;
      // A whole turn asks for nothing.
      const double by = angle ? std::remainder(it->second[i], kTwoPi) : it->second[i];
      if (std::abs(by) < kNoStep) continue;
      const auto kind = angle ? StepResponse::Kind::kAngle : StepResponse::Kind::kLength;
      components_.push_back({i, by, StepResponse(it->first, until, by, kind),
                             StepResponse(it->first, until, by), std::nullopt});
    }
  }
}

void EeStepMetrics::add(const TruthFrame& truth, const PoseVector& reference) {
  if (components_.empty() || truth.time < release_) return;
  const PoseVector deviation = eePose(truth, reference) - reference;
  for (Component& c : components_) {
    c.response.add(truth.time, deviation[c.index]);
    if (c.index >= 2 || !c.response.measured()) continue;
    const double ball = truth.state[kBallX + c.index];
    if (!c.ball_from) c.ball_from = ball;
    c.ball.add(truth.time, ball - *c.ball_from - c.by);
  }
}

std::map<std::string, double> EeStepMetrics::values() const {
  std::map<std::string, double> m;
  for (const Component& c : components_) {
    if (!c.response.measured()) continue;
    if (c.index == kRollComponent) {
      keepWorst(m, "ee_roll_given_percent", c.response.reachedPercent());
      continue;
    }
    const std::string stem = std::string("ee_") + kNames[c.index];
    if (const auto rise = c.response.riseTime()) keepWorst(m, stem + "_rise_s", *rise);
    keepWorst(m, stem + "_overshoot_percent", c.response.overshootPercent());
    if (const auto error = c.response.remainingError()) {
      keepWorst(m, c.index < 3 ? "ee_position_error_m" : "ee_angle_error_rad", std::abs(*error));
    }
    if (c.index < 2) keepWorst(m, "ball_backs_up_m", c.ball.againstFirst());
  }
  // One step that never rose makes the component's rise time meaningless.
  for (const Component& c : components_) {
    if (!c.response.measured() || c.response.riseTime()) continue;
    m.erase(std::string("ee_") + kNames[c.index] + "_rise_s");
  }
  return m;
}

std::vector<std::string> EeStepMetrics::names() {
  std::vector<std::string> names = {"ee_position_error_m", "ee_angle_error_rad",
                                    "ee_roll_given_percent", "ball_backs_up_m"};
  for (int i = 0; i < kRollComponent; ++i) {
    names.push_back(std::string("ee_") + kNames[i] + "_rise_s");
    names.push_back(std::string("ee_") + kNames[i] + "_overshoot_percent");
  }
  return names;
}

}  // namespace ballbot
