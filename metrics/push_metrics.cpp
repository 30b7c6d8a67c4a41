#include "metrics/push_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {


/// Horizontal part of the base's z axis, in W: where the base leans, sine of the angle.
Eigen::Vector2d horizontalLean(const StateVector& x) {
  return rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]).col(2).head<2>();
}

}  // namespace

PushMetrics::PushMetrics(std::vector<Interval> pushes) {
  std::sort(pushes.begin(), pushes.end(), [](const Interval& a, const Interval& b) { return a.start < b.start; });
  for (const Interval& push : pushes) {
    if (!responses_.empty() && push.start <= responses_.back().push.end) {
      responses_.back().push.end = std::max(responses_.back().push.end, push.end);
    } else {
      responses_.emplace_back();
      responses_.back().push = push;
    }
  }
}

void PushMetrics::add(const TruthFrame& truth) {
  // The newest push that has begun is the one the robot answers.
  auto it = std::find_if(responses_.rbegin(), responses_.rend(),
                         [&](const Response& r) { return r.push.start <= truth.time; });
  if (it == responses_.rend()) return;
  Response& r = *it;
  const Vector3 ball(truth.state[kBallX], truth.state[kBallY], 0);
  const Vector3 arm = truth.state.segment<3>(kArm1);
  const Eigen::Vector2d lean = horizontalLean(truth.state);
  if (!r.begun) {
    r.begun = true;
    r.ball.home = ball;
    r.ee.home = truth.p_WE;
    r.arm_home = arm;
    r.lean_home = lean;
  }
  r.ball.add(truth.time, ball, kReturnedDistance);
  r.ee.add(truth.time, truth.p_WE, kEeReturnedDistance);
  r.arm_excursion = std::max(r.arm_excursion, (arm - r.arm_home).cwiseAbs().maxCoeff());
  const double force = r.push.force.norm();
  if (force > 0) r.lean_against = std::max(r.lean_against, -(lean - r.lean_home).dot(r.push.force) / force);
}

void PushMetrics::Way::add(SimTime t, const Vector3& position, double returned_distance) {
  const double distance = (position - home).norm();
  excursion = std::max(excursion, distance);
  away = distance > returned_distance;
  if (away) last_away = t;
}

double PushMetrics::Way::returnAfter(SimTime end) const {
  return toSeconds(std::max(SimDuration::zero(), last_away - end));
}

std::map<std::string, double> PushMetrics::values() const {
  std::map<std::string, double> m;
  double ball = 0, ball_back = 0, ee = 0, ee_back = 0, arm = 0, lean = 1e300;
  bool any = false, all_ball_back = true, all_ee_back = true, any_force = false;
  for (const Response& r : responses_) {
    if (!r.begun) continue;
    any = true;
    ball = std::max(ball, r.ball.excursion);
    ee = std::max(ee, r.ee.excursion);
    arm = std::max(arm, r.arm_excursion);
    all_ball_back = all_ball_back && !r.ball.away;
    all_ee_back = all_ee_back && !r.ee.away;
    ball_back = std::max(ball_back, r.ball.returnAfter(r.push.end));
    ee_back = std::max(ee_back, r.ee.returnAfter(r.push.end));
    if (r.push.force.norm() > 0) {
      any_force = true;
      lean = std::min(lean, r.lean_against);
    }
  }
  if (!any) return m;
  m["largest_push_excursion_m"] = ball;
  m["largest_push_ee_excursion_m"] = ee;
  m["largest_push_arm_excursion_rad"] = arm;
  if (all_ball_back) m["longest_push_return_s"] = ball_back;
  if (all_ee_back) m["longest_push_ee_return_s"] = ee_back;
  if (any_force) m["least_lean_against_push_deg"] = std::asin(std::clamp(lean, -1.0, 1.0)) * kDegPerRad;
  return m;
}

std::vector<std::string> PushMetrics::names() {
  return {"largest_push_excursion_m",    "longest_push_return_s",          "largest_push_ee_excursion_m",
          "longest_push_ee_return_s",    "largest_push_arm_excursion_rad", "least_lean_against_push_deg"};
}

}  // namespace ballbot
