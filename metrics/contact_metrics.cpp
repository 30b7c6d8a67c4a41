#include "metrics/contact_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "model/frames.hpp"
#include "model/reduced_dynamics.hpp"

namespace ballbot {
namespace {

constexpr double kSmallest_N = 0.05;  // asked for: as good as none
constexpr double kUnchanged_N = 0.02;

double rms(double sum_of_squares, double time) { return std::sqrt(sum_of_squares / time); }

}  // namespace

ContactMetrics::ContactMetrics(const RobotParameters& robot, double door_stop)
    : robot_(robot),
      rest_pitch_(findEquilibrium(ReducedDynamics(robot), robot.nominal_arm).x[kPitch]),
      door_stop_(door_stop) {}

void ContactMetrics::addPhase(Sums& sums, double dt, const TruthFrame& truth,
                              const Vector3& asked_W, const Vector3& sensed_W) {
  const double asked = asked_W.norm();
  const Vector3 along = asked_W / asked;
  const double force = truth.contact_force_W.dot(along);
  sums.time += dt;
  sums.asked += dt * asked;
  sums.force += dt * force;
  sums.error2 += dt * (force - asked) * (force - asked);
  sums.sensing2 += dt * (sensed_W - truth.contact_force_W).squaredNorm();

  const Vector3 push = Vector3(-along.x(), -along.y(), 0).normalized();
  const Lean lean = leanOf(robot_, truth, push);
  // At rest without contact the base leans already, towards its own front.
  const double rest =
      std::asin(rotationFromYawPitchRoll(truth.state[kYaw], rest_pitch_, 0).col(2).dot(push));
  sums.shift += dt * lean.shift;
  sums.normal_shift += dt * lean.normal_shift;
  sums.balanced_shift += dt * lean.balanced_shift;
  sums.lean += dt * (lean.angle - rest);
}

void ContactMetrics::add(const TruthFrame& truth, const Vector3& asked_W, const Vector3& sensed_W) {
  const double dt = started_ ? toSeconds(truth.time - last_) : 0;
  started_ = true;
  last_ = truth.time;
  const double asked = asked_W.norm();
  if (std::abs(asked - last_asked_) > kUnchanged_N) {
    last_asked_ = asked;
    changed_ = truth.time;
  }
  const bool touching = truth.contact_phase != ContactPhase::kNone;
  if (touching && !touching_) ++phases_;
  touching_ = touching;
  if (touching) {
    touching_s_ += dt;
    if (truth.contact_phase == ContactPhase::kSliding) sliding_s_ += dt;
    largest_force_ = std::max(largest_force_, truth.contact_force_W.norm());
  }
  door_angle_ = truth.door_angle;
  largest_door_angle_ = std::max(largest_door_angle_, truth.door_angle);

  door_open_ = door_open_ || door_angle_ >= door_stop_;
  if (door_open_) return;
  if (asked < kSmallest_N) {
    touched_ = false;
    return;
  }
  any_asked_ = true;
  touched_ = touched_ || touching;
  if (!touched_) return;
  wanted_s_ += dt;
  if (touching) kept_s_ += dt;
  const bool steady = toSeconds(truth.time - changed_) >= kSteadyAfter;
  addPhase(steady ? steady_ : build_up_, dt, truth, asked_W, sensed_W);
}

std::map<std::string, double> ContactMetrics::values() const {
  std::map<std::string, double> m;
  if (phases_ == 0 && !any_asked_) return m;
  m["contact_phases"] = phases_;
  m["contact_time_s"] = touching_s_;
  m["final_door_angle_deg"] = door_angle_ * kDegPerRad;
  m["largest_door_angle_deg"] = largest_door_angle_ * kDegPerRad;
  if (touching_s_ > 0) {
    m["largest_contact_force_N"] = largest_force_;
    m["contact_sliding_percent"] = 100 * sliding_s_ / touching_s_;
  }
  if (wanted_s_ > 0) m["contact_kept_percent"] = 100 * kept_s_ / wanted_s_;
  if (build_up_.time > 0) {
    m["force_rms_error_build_up_N"] = rms(build_up_.error2, build_up_.time);
  }
  if (steady_.time <= 0) return m;
  const Sums& s = steady_;
  m["force_mean_N"] = s.force / s.time;
  m["force_mean_error_percent"] = 100 * std::abs(s.force - s.asked) / s.asked;
  m["force_rms_error_steady_N"] = rms(s.error2, s.time);
  m["force_rms_error_percent"] = 100 * rms(s.error2, s.time) / (s.asked / s.time);
  m["force_sensing_rms_error_N"] = rms(s.sensing2, s.time);
  m["push_lean_deg"] = kDegPerRad * s.lean / s.time;
  m["com_shift_m"] = s.shift / s.time;
  m["com_shift_expected_m"] = s.normal_shift / s.time;
  m["com_shift_error_percent"] = 100 * std::abs(s.shift / s.normal_shift - 1);
  m["com_balance_error_percent"] = 100 * std::abs(s.shift / s.balanced_shift - 1);
  return m;
}

std::vector<std::string> ContactMetrics::names() {
  return {"com_balance_error_percent", "com_shift_error_percent",
          "com_shift_expected_m",      "com_shift_m",
          "contact_kept_percent",      "contact_phases",
          "contact_sliding_percent",   "contact_time_s",
          "final_door_angle_deg",      "force_mean_N",
          "force_mean_error_percent",  "force_rms_error_build_up_N",
          "force_rms_error_percent",   "force_rms_error_steady_N",
          "force_sensing_rms_error_N", "largest_contact_force_N",
          "largest_door_angle_deg",    "push_lean_deg"};
}

}  // namespace ballbot
