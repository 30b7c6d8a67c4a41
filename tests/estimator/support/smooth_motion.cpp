#include "tests/estimator/support/smooth_motion.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/angle.hpp"
#include "model/frames.hpp"

namespace ballbot::test {
namespace {

/// A function of time with its first two derivatives.
struct Jet {
  double v = 0, d = 0, dd = 0;
};

Jet operator*(const Jet& a, const Jet& b) {
  return {a.v * b.v, a.d * b.v + a.v * b.d, a.dd * b.v + 2 * a.d * b.d + a.v * b.dd};
}

/// 0 before 0, 1 after `fade`, three continuous derivatives: 35 s^4 - 84 s^5 + 70 s^6 - 20 s^7.
Jet fadeIn(double t, double fade) {
  const double s = t / fade;
  if (s <= 0) return {};
  if (s >= 1) return {1, 0, 0};
  const double s2 = s * s, s3 = s2 * s;
  return {s3 * s * (35 + s * (-84 + s * (70 - 20 * s))),
          140 * s3 * (1 - s) * (1 - s) * (1 - s) / fade,
          420 * s2 * (1 - s) * (1 - s) * (1 - 2 * s) / (fade * fade)};
}

Jet sum(const std::vector<Harmonic>& harmonics, double t) {
  Jet out;
  for (const Harmonic& h : harmonics) {
    const double w = kTwoPi * h.frequency_Hz;
    const double s = std::sin(w * t + h.phase), c = std::cos(w * t + h.phase);
    out.v += h.amplitude * (s - std::sin(h.phase));
    out.d += h.amplitude * w * c;
    out.dd -= h.amplitude * w * w * s;
  }
  return out;
}

double spinOf(const std::vector<SpinPulse>& pulses, double t_s) {
  double spin = 0;
  for (const SpinPulse& p : pulses) {
    const auto risen = [&](double since) {
      return p.ramp_s > 0 ? std::clamp((t_s - since) / p.ramp_s, 0.0, 1.0)
                          : (t_s > since ? 1.0 : 0.0);
    };
    spin += p.rate * (risen(p.from_s) - risen(p.to_s));
  }
  return spin;
}

}  // namespace

MotionSample sampleMotion(const MotionScript& script, const RobotParameters& robot, double t_s) {
  const double t = t_s - script.rest_s;
  const Jet fade = fadeIn(t, script.fade_s);
  std::array<Jet, 5> q;
  for (std::size_t i = 0; i < 5; ++i) q[i] = fade * sum(script.harmonics[i], t);
  const Jet &x = q[0], &y = q[1];
  Jet yaw = q[2], pitch = q[3], roll = q[4];
  yaw.v += script.rest_yaw_pitch_roll[0];
  pitch.v += script.rest_yaw_pitch_roll[1];
  roll.v += script.rest_yaw_pitch_roll[2];

  const double sy = std::sin(pitch.v), cy = std::cos(pitch.v);
  const double sx = std::sin(roll.v), cx = std::cos(roll.v);
  MotionSample out;
  out.p_WK << x.v, y.v, 0;
  out.v_WK_W << x.d, y.d, 0;
  out.yaw_pitch_roll << yaw.v, pitch.v, roll.v;
  out.R_WB = rotationFromYawPitchRoll(yaw.v, pitch.v, roll.v);
  out.w_WB_B << roll.d - sy * yaw.d,   //
      cx * pitch.d + sx * cy * yaw.d,  //
      -sx * pitch.d + cx * cy * yaw.d;
  const Vector3 dw(roll.dd - cy * pitch.d * yaw.d - sy * yaw.dd,
                   -sx * roll.d * pitch.d + cx * pitch.dd + cx * roll.d * cy * yaw.d -
                       sx * sy * pitch.d * yaw.d + sx * cy * yaw.dd,
                   -cx * roll.d * pitch.d - sx * pitch.dd - sx * roll.d * cy * yaw.d -
                       cx * sy * pitch.d * yaw.d + cx * cy * yaw.dd);
  out.specific_force_B = out.R_WB.transpose() * Vector3(x.dd, y.dd, robot.gravity) +
                         dw.cross(robot.p_BI_B) + out.w_WB_B.cross(out.w_WB_B.cross(robot.p_BI_B));

  // Written out from the contact geometry, not through OmniwheelKinematics.
  out.spin = spinOf(script.spins, t_s);
  const Vector3 kappa_B =
      out.R_WB.transpose() * Vector3(-y.d / robot.ball.radius, x.d / robot.ball.radius, out.spin);
  for (int i = 0; i < kWheelCount; ++i) {
    out.wheel_rates[i] =
        -robot.ball.radius / robot.wheels.radius * robot.wheelAxle(i).dot(kappa_B - out.w_WB_B);
  }
  return out;
}

MotionMeans averageMotion(const MotionScript& script, const RobotParameters& robot, double from_s,
                          double to_s) {
  static constexpr std::array<double, 3> kNode = {0.0, 0.538469310105683091, 0.906179845938663993};
  static constexpr std::array<double, 3> kWeight = {0.284444444444444444, 0.239314335249683234,
                                                    0.118463442528094544};
  MotionMeans mean;
  const double middle = 0.5 * (from_s + to_s), half = 0.5 * (to_s - from_s);
  const auto add = [&](double node, double weight) {
    const MotionSample s = sampleMotion(script, robot, middle + node * half);
    mean.specific_force_B += weight * s.specific_force_B;
    mean.w_WB_B += weight * s.w_WB_B;
    mean.spin += weight * s.spin;
    mean.wheel_rates += weight * s.wheel_rates;
  };
  add(0.0, kWeight[0]);
  for (std::size_t i = 1; i < 3; ++i) {
    add(-kNode[i], kWeight[i]);
    add(kNode[i], kWeight[i]);
  }
  return mean;
}

MotionScript livelyMotion() {
  MotionScript m;
  m.rest_yaw_pitch_roll << 0.0, 0.02, -0.01;
  m.harmonics[0] = {{0.55, 0.09, 0.3}, {0.10, 0.31, 1.1}};
  m.harmonics[1] = {{0.50, 0.07, 2.0}, {0.08, 0.37, 0.2}};
  m.harmonics[2] = {{0.60, 0.05, 0.0}, {0.20, 0.23, 0.7}};
  m.harmonics[3] = {{0.07, 0.31, 1.0}, {0.03, 0.83, 0.1}};
  m.harmonics[4] = {{0.06, 0.37, 0.4}, {0.03, 0.71, 1.9}};
  return m;
}

MotionScript standingStill() {
  MotionScript m;
  m.rest_yaw_pitch_roll << 0.0, 0.02, -0.01;
  return m;
}

RobotParameters estimatorTestRobot() {
  RobotParameters robot;
  robot.name = "estimator_test";
  robot.ball.radius = 0.125;
  robot.wheels.radius = 0.064;
  robot.wheels.contact_zenith = kTwoPi / 8;
  robot.wheels.azimuth = {0.0, kTwoPi / 3, 2 * kTwoPi / 3};
  robot.p_BI_B << 0.05, 0.0, 0.30;
  return robot;
}

}  // namespace ballbot::test
