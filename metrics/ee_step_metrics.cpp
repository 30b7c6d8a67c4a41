#include "metrics/ee_step_metrics.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "model/frames.hpp"

namespace ballbot {
namespace {

constexpr const char* kNames[kPoseDim] = {"x", "y", "z", "yaw", "pitch", "roll"};
constexpr int kRollComponent = 5;

void keepWorst(std::map<std::string, double>& values, const std::string& name, double value) {
  const auto it = values.find(name);
  values[name] = it == values.end() ? value : std::max(it->second, value);
}

}  // namespace

PoseVector eePose(const TruthFrame& truth) {
  const Eigen::Vector4d& q = truth.quat_WE;
  PoseVector pose;
  pose << truth.p_WE, yawPitchRollFromRotation(Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix());
  return pose;
}

EeStepMetrics::EeStepMetrics(const PoseVector& reference, std::vector<EeStep> steps, SimTime end) {
  std::sort(steps.begin(), steps.end(), [](const EeStep& a, const EeStep& b) { return a.at < b.at; });
  PoseVector target = reference;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    target += steps[k].by;
    const SimTime until = k + 1 < steps.size() ? steps[k + 1].at : end;
    for (int i = 0; i < kPoseDim; ++i) {
      const double by = steps[k].by[i];
      if (by == 0) continue;
      components_.push_back({i, StepResponse(steps[k].at, until, by, target[i]),
                             StepResponse(steps[k].at, until, by, by)});
    }
  }
}

void EeStepMetrics::add(const TruthFrame& truth) {
  if (components_.empty()) return;
  const PoseVector pose = eePose(truth);
  for (Component& c : components_) {
    c.response.add(truth.time, pose[c.index]);
    if (c.index < 2) c.ball.add(truth.time, truth.state[kBallX + c.index]);
  }
}

std::map<std::string, double> EeStepMetrics::values() const {
  std::map<std::string, double> m;
  for (const Component& c : components_) {
    const std::string stem = std::string("ee_") + kNames[c.index];
    if (c.index == kRollComponent) {
      keepWorst(m, "ee_roll_given_percent", c.response.reachedPercent());
      continue;
    }
    if (const auto rise = c.response.riseTime()) keepWorst(m, stem + "_rise_s", *rise);
    keepWorst(m, stem + "_overshoot_percent", c.response.overshootPercent());
    if (const auto error = c.response.remainingError()) {
      keepWorst(m, c.index < 3 ? "ee_position_error_m" : "ee_angle_error_rad", std::abs(*error));
    }
    if (c.index < 2) keepWorst(m, "ball_backs_up_m", c.ball.againstFirst());
  }
  // One step that never rose makes the component's rise time meaningless.
  for (const Component& c : components_) {
    if (!c.response.riseTime()) m.erase(std::string("ee_") + kNames[c.index] + "_rise_s");
  }
  return m;
}

std::vector<std::string> EeStepMetrics::names() {
  std::vector<std::string> names = {"ee_position_error_m", "ee_angle_error_rad", "ee_roll_given_percent", "ball_backs_up_m"};
  for (int i = 0; i < kRollComponent; ++i) {
    names.push_back(std::string("ee_") + kNames[i] + "_rise_s");
    names.push_back(std::string("ee_") + kNames[i] + "_overshoot_percent");
  }
  return names;
}

}  // namespace ballbot
