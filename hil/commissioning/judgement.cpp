#include "hil/commissioning/judgement.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"

namespace ballbot {
namespace {

using Verdict = Judgement::Verdict;
using Axes = std::array<double, 3>;

// What a person with a mark and a set square is off by, and what encoders of one shaft may be.
constexpr double kTurnTolerance = 0.12, kMotorTolerance = 0.02;
constexpr double kMoved = 5 * kRadPerDeg;
constexpr double kArmPose = 3 * kRadPerDeg;  // zero marks by eye
constexpr double kUpright = 6 * kRadPerDeg;  // of a robot in its stand
constexpr double kGravity = 9.81, kGravityTolerance = 0.03;
constexpr double kStillGyro = 0.05;                             // [rad/s]
constexpr double kLeastTilt = 10 * kRadPerDeg, kOffAxis = 0.4;  // share of the turn
constexpr double kVertical = 7 * kRadPerDeg;                    // gyroscope against gravity
constexpr double kLeastGain = 0.75, kMostGain = 1.33;           // torque felt over expected
constexpr double kLeastSpring = 0.8, kMostSpring = 1.25;        // of what is configured
constexpr double kLeastDirection = 0.3, kOtherShare = 0.5;

const char* const kAxisName[3] = {"x", "y", "z"};

double norm(const Axes& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

std::size_t largestOf(const Axes& v) {
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(v[i]) > std::abs(v[k])) k = i;
  }
  return k;
}

double angleBetween(const Axes& a, const Axes& b) {
  const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return std::acos(std::clamp(dot / (norm(a) * norm(b)), -1.0, 1.0));
}

/// A vector that stands still, as seen from a base that has turned by `angle` about `axis`.
Axes seenFromTurned(const Axes& v, const Axes& axis, double angle) {
  const double c = std::cos(angle), s = -std::sin(angle);
  const double along = v[0] * axis[0] + v[1] * axis[1] + v[2] * axis[2];
  const Axes cross{axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2],
                   axis[0] * v[1] - axis[1] * v[0]};
  Axes out{};
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = v[i] * c + cross[i] * s + axis[i] * along * (1 - c);
  }
  return out;
}

std::string axisText(std::size_t k, double sign) {
  return fmt::format("{}{}", sign < 0 ? "-" : "+", kAxisName[k]);
}

std::string vectorText(const Axes& v) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", v[0], v[1], v[2]);
}

Judgement wrong(std::string words) { return {Verdict::kWrong, std::move(words)}; }
Judgement wait(std::string words) { return {Verdict::kWait, std::move(words)}; }
Judgement good(std::string words) { return {Verdict::kGood, std::move(words)}; }

const DriveConfig& driveOf(const BenchConfig& config, std::size_t i) { return config.drives[i]; }

std::string degrees(double angle) { return fmt::format("{:.1f} deg", angle * kDegPerRad); }

Judgement judgeRatio(const DriveConfig& d, double asked, double joint, double motor) {
  const double ratio = joint / asked;
  if (std::abs(ratio - 1) > kTurnTolerance) {
    return wrong(fmt::format(
        "it was turned by {} and its encoder says {}: encoder_counts_per_turn is {:.0f} and would "
        "be about {:.0f}, or a gear lies between",
        degrees(asked), degrees(joint), d.scaling.encoder_counts,
        d.scaling.encoder_counts * std::abs(ratio)));
  }
  const double shafts = motor / joint;
  if (std::abs(shafts - 1) > kMotorTolerance) {
    return wrong(fmt::format(
        "its joint encoder says {} and its motor encoder {}: motor_encoder_counts_per_turn is "
        "{:.0f} and would be about {:.0f}, negative where one of the two counts backwards",
        degrees(joint), degrees(motor), d.scaling.motor_encoder_counts,
        d.scaling.motor_encoder_counts * shafts));
  }
  return good(fmt::format("turned by {}, motor encoder {}", degrees(joint), degrees(motor)));
}

}  // namespace

Judgement judgeStand(const BenchConfig& config, const HandWatch& watch) {
  const Axes& force = watch.motion().before;
  const Axes& bias = watch.gyroBias();
  if (std::abs(norm(force) / kGravity - 1) > kGravityTolerance) {
    return wrong(fmt::format(
        "the IMU feels {:.2f} m/s^2 at rest, not {:.2f}: accel_resolution_m_per_s2, or its range",
        norm(force), kGravity));
  }
  const double lean = angleBetween(force, {0, 0, 1});
  if (lean > kUpright) {
    const std::size_t k = largestOf(force);
    return wrong(fmt::format(
        "the IMU feels {} m/s^2, {} from its z axis; upright it is (0, 0, {:.2f}). {}",
        vectorText(force), degrees(lean), kGravity,
        k == 2 && force[2] > 0 ? "Stand the robot upright, or mend the IMU's mounting"
                               : "Its " + axisText(k, force[k]) +
                                     " axis points upwards: the IMU "
                                     "is mounted otherwise than the robot's model has it"));
  }
  if (norm(bias) > kStillGyro) {
    return wrong(fmt::format("the gyroscope says {} rad/s at rest", vectorText(bias)));
  }
  for (std::size_t i = 3; i < kDriveCount; ++i) {
    const double off = watch.jointAngle()[i] - config.commissioning.arm_pose[i - 3];
    if (std::abs(off) <= kArmPose) continue;
    return wrong(fmt::format(
        "{} says {} and stands at its mark, {}: offset_deg is {:.2f} and would be about {:.2f}",
        driveOf(config, i).name, degrees(watch.jointAngle()[i]),
        degrees(config.commissioning.arm_pose[i - 3]),
        driveOf(config, i).scaling.offset * kDegPerRad,
        (driveOf(config, i).scaling.offset + off) * kDegPerRad));
  }
  return good(
      fmt::format("{:.2f} m/s^2 upwards, {} off the IMU's z axis", norm(force), degrees(lean)));
}

Judgement judgeUpright(const HandWatch& watch) {
  const double lean = angleBetween(watch.motion().after, {0, 0, 1});
  const std::string words = degrees(lean) + " off the IMU's z axis";
  return lean <= kUpright ? good(words) : wait(words);
}

Judgement judgeTurn(const BenchConfig& config, const CommissioningTask& task,
                    const HandWatch& watch) {
  const HandMotion& m = watch.motion();
  const auto asked = static_cast<std::size_t>(task.drive);
  std::size_t most = asked;
  for (std::size_t j = 0; j < kDriveCount; ++j) {
    if (std::abs(m.joint[j]) > std::abs(m.joint[most])) most = j;
  }
  if (norm(m.turned) > kLeastTilt) {
    return wrong(fmt::format("the whole robot turned by {}: hold it", degrees(norm(m.turned))));
  }
  if (std::abs(m.joint[most]) < kMoved) return wait("no joint has moved yet");
  const DriveConfig& d = driveOf(config, asked);
  if (most != asked) {
    return wrong(fmt::format(
        "{} was turned, and {} (bus {}, node {}) says that it moved, by {}, while node {} says {}: "
        "their node numbers, buses or cables are exchanged",
        d.name, driveOf(config, most).name, driveOf(config, most).bus, driveOf(config, most).node,
        degrees(m.joint[most]), d.node, degrees(m.joint[asked])));
  }
  // Turned the right way so far, and not all of it: perhaps the person takes it in two parts.
  const double done = m.joint[asked] / task.angle;
  if (done < 0) {
    return wrong(fmt::format(
        "its encoder says {}, the wrong way: sign is {:.0f} and would be {:.0f}, or it was turned "
        "the other way itself (arrows: docs/bench-wiring.md)",
        degrees(m.joint[asked]), d.scaling.sign, -d.scaling.sign));
  }
  Judgement j = judgeRatio(d, task.angle, m.joint[asked], m.motor[asked]);
  if (j.verdict == Verdict::kWrong && done < 1 - kTurnTolerance) j.verdict = Verdict::kWait;
  return j;
}

Judgement judgeTilt(const CommissioningTask& task, const HandWatch& watch) {
  const HandMotion& m = watch.motion();
  const double size = norm(m.turned);
  if (size < kLeastTilt) {
    const double lean = angleBetween(m.before, m.after);
    if (lean < kLeastTilt) return wait(fmt::format("turned by {} so far", degrees(size)));
    return wrong(fmt::format(
        "gravity moved by {} in the base and the gyroscope felt {}: gyro_resolution_rad_per_s, or "
        "the gyroscope is dead",
        degrees(lean), degrees(size)));
  }
  const std::size_t axis = largestOf(task.axis);
  const std::size_t felt = largestOf(m.turned);
  const double along = m.turned[axis] * task.axis[axis];
  double off = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k != axis) off = std::hypot(off, m.turned[k]);
  }
  if (felt != axis || along < 0 || off > kOffAxis * size) {
    return wrong(fmt::format(
        "the base turned about {} and the gyroscope felt it about {} {}: its axes are not those "
        "of the robot's model, or the base was turned the other way",
        axisText(axis, task.axis[axis]), axisText(felt, m.turned[felt]), vectorText(m.turned)));
  }
  const Axes expected = seenFromTurned(m.before, task.axis, along);
  const double apart = angleBetween(expected, m.after);
  if (apart > kVertical + 0.15 * size) {
    return wrong(fmt::format(
        "the gyroscope felt {} about {}, so the accelerometer should say {} and says {}: its axes "
        "are not those of the gyroscope",
        degrees(along), axisText(axis, task.axis[axis]), vectorText(expected),
        vectorText(m.after)));
  }
  return good(fmt::format("{} about {}, gravity within {}", degrees(along),
                          axisText(axis, task.axis[axis]), degrees(apart)));
}

Judgement judgePulse(const BenchConfig& config, int drive, const PulseWatch& w) {
  const DriveConfig& d = driveOf(config, static_cast<std::size_t>(drive));
  if (w.otherTorque() > kOtherShare * w.peak()) {
    return wrong(fmt::format("{} was told {:.2f} Nm, and {} felt {:.2f} Nm", d.name, w.peak(),
                             driveOf(config, static_cast<std::size_t>(w.other())).name,
                             w.otherTorque()));
  }
  if (w.gain() < kLeastGain || w.gain() > kMostGain) {
    return wrong(fmt::format(
        "it felt {:.2f} times the torque that was expected: rated_torque_Nm, the torque's sign, or "
        "torque_frequency_Hz (ballbot identify)",
        w.gain()));
  }
  const double spring = w.stiffness() / d.scaling.spring_stiffness;
  if (spring < kLeastSpring || spring > kMostSpring) {
    return wrong(fmt::format(
        "torque over the spring's deflection is {:.0f} Nm/rad, configured {:.0f}: {}",
        w.stiffness(), d.scaling.spring_stiffness,
        spring < 0 ? "torque or one encoder has the wrong sign" : "spring_stiffness_Nm_per_rad"));
  }
  const bool moved = w.fastest() > config.safety.rest_velocity;
  if (moved && w.direction() < kLeastDirection) {
    return wrong(fmt::format(
        "the joint moves against its torque (correlation {:.2f}): the signs of torque and encoder "
        "are opposite",
        w.direction()));
  }
  return good(fmt::format("{:.2f} Nm, felt {:.2f} of it, spring {:.0f} Nm/rad, {}", w.peak(),
                          w.gain(), w.stiffness(),
                          moved ? "moves with its torque" : "held, so its motion says nothing"));
}

}  // namespace ballbot
