#include "metrics/push_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "model/frames.hpp"

namespace ballbot {
namespace {

/// Of a reference from one instant to the next: more is no motion [m].
constexpr double kStep = 0.01;

/// Horizontal part of the base's z axis, in W: where the base leans, sine of the angle.
Eigen::Vector2d horizontalLean(const StateVector& x) {
  return rotationFromYawPitchRoll(x[kYaw], x[kPitch], x[kRoll]).col(2).head<2>();
}

}  // namespace

PushMetrics::PushMetrics(std::vector<Interval> pushes, SimTime release) {
  std::sort(pushes.begin(), pushes.end(),
            [](const Interval& a, const Interval& b) { return a.start < b.start; });
  for (const Interval& push : pushes) {
    const SimTime start = std::max(push.start, release);
    if (push.end <= start) continue;
    if (responses_.empty() || start > responses_.back().end) {
      responses_.emplace_back();
      responses_.back().start = start;
    }
    Response& r = responses_.back();
    r.end = std::max(r.end, push.end);
    r.impulse += toSeconds(push.end - start) * push.force;
  }
}

void PushMetrics::add(const TruthFrame& truth, const PlaceReference& reference) {
  if (!started_) {
    started_ = true;  // of a run that continues another: pushes that were before are not its own
    const auto before = [&](const Response& r) { return r.start < truth.time; };
    responses_.erase(std::remove_if(responses_.begin(), responses_.end(), before),
                     responses_.end());
  }
  // The newest push that has begun is the one the robot answers.
  auto it = std::find_if(responses_.rbegin(), responses_.rend(),
                         [&](const Response& r) { return r.start <= truth.time; });
  if (it == responses_.rend()) return;
  Response& r = *it;
  const Vector3 ball(truth.state[kBallX], truth.state[kBallY], 0);
  const ArmVector arm = truth.state.segment<kArmJointCount>(kArm1);
  const Eigen::Vector2d lean = horizontalLean(truth.state);
  if (!r.begun) {
    r.begun = true;
    r.arm_home = arm;
    r.lean_home = lean;
  }
  r.seen_to_its_end = r.seen_to_its_end || truth.time >= r.end;
  r.ball.add(truth.time, ball, {reference.ball.x(), reference.ball.y(), 0},
             {reference.ball_asked[0], reference.ball_asked[1], 0}, kReturnedDistance);
  r.ee.add(truth.time, truth.p_WE, reference.ee, reference.ee_asked, kEeReturnedDistance);
  r.arm_excursion = std::max(r.arm_excursion, (arm - r.arm_home).cwiseAbs().maxCoeff());
  const double impulse = r.impulse.norm();
  if (impulse > 0) {
    r.lean_against = std::max(r.lean_against, -(lean - r.lean_home).dot(r.impulse) / impulse);
  }
}

void PushMetrics::Way::add(SimTime t, const Vector3& position, const Vector3& reference,
                           const Eigen::Array3d& asked, double returned_distance) {
  if (over) return;
  if (!begun) found_at = position;
  const Vector3 home = (asked > 0).select(reference.array(), found_at.array()).matrix();
  if (!begun) {
    begun = true;
    first_deviation = position - home;
  } else if ((home - last_home).norm() > kStep) {
    over = true;  // whoever asks for another place does not ask for the way back
    return;
  }
  last_home = home;
  const Vector3 deviation = position - home;
  excursion = std::max(excursion, (deviation - first_deviation).norm());
  away = deviation.norm() > returned_distance;
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
    all_ball_back = all_ball_back && r.seen_to_its_end && !r.ball.away;
    all_ee_back = all_ee_back && r.seen_to_its_end && !r.ee.away;
    ball_back = std::max(ball_back, r.ball.returnAfter(r.end));
    ee_back = std::max(ee_back, r.ee.returnAfter(r.end));
    if (r.impulse.norm() > 0) {
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
  if (any_force)
    m["least_lean_against_push_deg"] = std::asin(std::clamp(lean, -1.0, 1.0)) * kDegPerRad;
  return m;
}

std::vector<std::string> PushMetrics::names() {
  return {"largest_push_excursion_m",       "longest_push_return_s",
          "largest_push_ee_excursion_m",    "longest_push_ee_return_s",
          "largest_push_arm_excursion_rad", "least_lean_against_push_deg"};
}

}  // namespace ballbot
