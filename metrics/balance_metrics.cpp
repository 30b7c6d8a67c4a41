#include "metrics/balance_metrics.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"

namespace ballbot {
namespace {}  // namespace

double tiltAngle(const StateVector& x) {
  // z_B . z_W = cos(pitch) cos(roll)
  return std::acos(std::clamp(std::cos(x[kPitch]) * std::cos(x[kRoll]), -1.0, 1.0));
}

void BalanceMetrics::add(const TruthFrame& truth, const ActuatorCommand& command) {
  last_ = truth;
  seen_ = true;
  if (truth.time < release_) return;
  if (!released_) {
    released_ = true;
    home_ = truth.state.segment<2>(kBallX);
    last_time_ = truth.time;
  }
  const double dt = toSeconds(truth.time - last_time_);
  last_time_ = truth.time;
  const double tilt = tiltAngle(truth.state);
  const double excursion = (truth.state.segment<2>(kBallX) - home_).norm();
  largest_tilt_ = std::max(largest_tilt_, tilt);
  largest_excursion_ = std::max(largest_excursion_, excursion);
  excursion2_integral_ += dt * excursion * excursion;
  tilt2_integral_ += dt * tilt * tilt;
  observed_s_ += dt;
  largest_wheel_torque_ =
      std::max(largest_wheel_torque_, truth.joint_torque.head<kWheelCount>().cwiseAbs().maxCoeff());
  largest_arm_torque_ = std::max(largest_arm_torque_,
                                 truth.joint_torque.tail<kArmJointCount>().cwiseAbs().maxCoeff());
  torque_error2_integral_ +=
      dt * (truth.joint_torque - command.torque).head<kWheelCount>().squaredNorm() / kWheelCount;
  arm_torque_error2_integral_ +=
      dt * (truth.joint_torque - command.torque).tail<kArmJointCount>().squaredNorm() /
      kArmJointCount;
  if (!fell_ && !(tilt < kFallTiltDeg / kDegPerRad)) {
    fell_ = true;
    fall_time_ = truth.time;
  }
}

std::map<std::string, double> BalanceMetrics::values() const {
  std::map<std::string, double> m;
  if (!seen_) return m;
  m["fell"] = fell_ ? 1 : 0;
  if (fell_) m["time_of_fall_s"] = toSeconds(fall_time_);
  if (!released_) return m;
  m["largest_tilt_deg"] = largest_tilt_ * kDegPerRad;
  m["final_tilt_deg"] = tiltAngle(last_.state) * kDegPerRad;
  m["largest_ball_excursion_m"] = largest_excursion_;
  m["final_ball_position_error_m"] = (last_.state.segment<2>(kBallX) - home_).norm();
  m["largest_wheel_torque_Nm"] = largest_wheel_torque_;
  m["largest_arm_torque_Nm"] = largest_arm_torque_;
  if (observed_s_ > 0) {
    m["rms_ball_excursion_m"] = std::sqrt(excursion2_integral_ / observed_s_);
    m["rms_tilt_deg"] = std::sqrt(tilt2_integral_ / observed_s_) * kDegPerRad;
    m["rms_arm_torque_error_Nm"] = std::sqrt(arm_torque_error2_integral_ / observed_s_);
    m["rms_wheel_torque_error_Nm"] = std::sqrt(torque_error2_integral_ / observed_s_);
  }
  return m;
}

std::vector<std::string> BalanceMetrics::names() {
  return {"fell",
          "final_ball_position_error_m",
          "final_tilt_deg",
          "largest_arm_torque_Nm",
          "largest_ball_excursion_m",
          "largest_tilt_deg",
          "largest_wheel_torque_Nm",
          "rms_arm_torque_error_Nm",
          "rms_ball_excursion_m",
          "rms_tilt_deg",
          "rms_wheel_torque_error_Nm",
          "time_of_fall_s"};
}

}  // namespace ballbot
