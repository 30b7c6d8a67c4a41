#include "estimator/two_state_settings.hpp"

#include "core/angle.hpp"
#include "core/config_reader.hpp"

namespace ballbot {
namespace {

void readNoise(ConfigReader in, FilterNoise& n) {
  n.gyro_density = in.numberOr("gyro_rad_per_s_per_sqrt_Hz", n.gyro_density, {1e-7, 1});
  n.accel_density = in.numberOr("accel_m_per_s2_per_sqrt_Hz", n.accel_density, {1e-6, 10});
  n.accel_inflation = in.numberOr("accel_inflation", n.accel_inflation, {1, 100});
  n.gyro_bias_walk =
      in.numberOr("gyro_bias_walk_rad_per_s_per_sqrt_s", n.gyro_bias_walk, {1e-9, 1});
  n.accel_bias_walk =
      in.numberOr("accel_bias_walk_m_per_s2_per_sqrt_s", n.accel_bias_walk, {1e-8, 1});
  n.wheel_increment = in.numberOr("wheel_increment_rad", n.wheel_increment, {1e-6, 0.1});
  n.position_walk = in.numberOr("position_walk_m_per_sqrt_s", n.position_walk, {1e-6, 0.1});
  n.attitude_walk = in.numberOr("attitude_walk_rad_per_sqrt_s", n.attitude_walk, {1e-6, 0.1});
  n.coasting_accel = in.numberOr("coasting_accel_m_per_s2", n.coasting_accel, {0.1, 100});
  n.coasting_angular_accel =
      in.numberOr("coasting_angular_accel_rad_per_s2", n.coasting_angular_accel, {0.1, 1000});
  in.finish();
}

void readInitial(ConfigReader in, InitialUncertainty& u) {
  u.position = in.numberOr("position_m", u.position, {1e-6, 10});
  u.yaw = kRadPerDeg * in.numberOr("yaw_deg", u.yaw / kRadPerDeg, {1e-4, 180});
  u.tilt = kRadPerDeg * in.numberOr("tilt_deg", u.tilt / kRadPerDeg, {0.01, 45});
  u.velocity_at_rest = in.numberOr("velocity_at_rest_m_per_s", u.velocity_at_rest, {1e-5, 10});
  u.omega_at_rest = in.numberOr("omega_at_rest_rad_per_s", u.omega_at_rest, {1e-5, 10});
  u.velocity_unknown = in.numberOr("velocity_unknown_m_per_s", u.velocity_unknown, {1e-3, 10});
  u.omega_unknown = in.numberOr("omega_unknown_rad_per_s", u.omega_unknown, {1e-3, 10});
  u.accel_bias = in.numberOr("accel_bias_m_per_s2", u.accel_bias, {1e-5, 5});
  u.gyro_bias = in.numberOr("gyro_bias_rad_per_s", u.gyro_bias, {1e-6, 1});
  in.finish();
}

void readGate(ConfigReader in, GateSettings& g) {
  g.wheel_gate_sigma = in.numberOr("wheel_gate_sigma", g.wheel_gate_sigma, {2, 1e6});
  g.wheel_slip_sigma = in.numberOr("wheel_slip_sigma", g.wheel_slip_sigma, {0.5, 1e6});
  g.accel_jump_m_per_s2 = in.numberOr("accel_jump_m_per_s2", g.accel_jump_m_per_s2, {0.05, 1e6});
  g.gyro_jump_rad_per_s = in.numberOr("gyro_jump_rad_per_s", g.gyro_jump_rad_per_s, {0.005, 1e6});
  g.chi_square_limit = in.numberOr("chi_square_limit", g.chi_square_limit, {10, 1e12});
  g.state_doubt_after_s = in.numberOr("state_doubt_after_s", g.state_doubt_after_s, {0.005, 1e6});
  in.finish();
}

void readPose(ConfigReader in, ExternalPoseSettings& p) {
  p.position_sigma_m = in.numberOr("position_sigma_m", p.position_sigma_m, {1e-5, 10});
  p.yaw_sigma_rad = kRadPerDeg * in.numberOr("yaw_sigma_deg", p.yaw_sigma_rad / kRadPerDeg, {1e-3, 180});
  p.chi_square_limit = in.numberOr("chi_square_limit", p.chi_square_limit, {5, 1e12});
  in.finish();
}

void readBalance(ConfigReader in, BalanceSettings& b) {
  b.enabled = in.booleanOr("enabled", b.enabled);
  b.momentum_sigma = in.numberOr("momentum_kg_m2_per_s", b.momentum_sigma, {1e-4, 100});
  b.moment_sigma = in.numberOr("moment_Nm", b.moment_sigma, {1e-3, 100});
  b.window_s = in.numberOr("window_s", b.window_s, {0.01, 10});
  b.push_chi_square = in.numberOr("push_chi_square", b.push_chi_square, {2, 1e12});
  in.finish();
}

}  // namespace

TwoStateSettings TwoStateSettings::read(ConfigReader& in) {
  TwoStateSettings s;
  if (in.has("noise")) readNoise(in.child("noise"), s.noise);
  if (in.has("initial")) readInitial(in.child("initial"), s.initial);
  if (in.has("gate")) readGate(in.child("gate"), s.gate);
  if (in.has("balance")) readBalance(in.child("balance"), s.balance);
  s.use_external_pose = in.has("external_pose");
  if (s.use_external_pose) readPose(in.child("external_pose"), s.pose);
  s.iterations = in.integerOr("iterations", s.iterations, {2, 10});
  s.arm_rate_time_constant_s =
      in.numberOr("arm_rate_time_constant_s", s.arm_rate_time_constant_s, {0, 0.1});
  s.alignment_samples = in.integerOr("alignment_samples", s.alignment_samples, {1, 1e6});
  s.imu_wait = in.durationOr("imu_wait_ms", s.imu_wait, {0, 15});
  const auto tilt = in.numbersOr<2>("initial_tilt_error_deg", {0, 0}, {-45, 45});
  s.initial_tilt_error = kRadPerDeg * Eigen::Vector2d(tilt[0], tilt[1]);
  return s;
}

}  // namespace ballbot
