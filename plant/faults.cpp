#include "plant/faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/config_visitor.hpp"
#include "model/joint_names.hpp"

namespace ballbot {
namespace {

int readJoint(ConfigReader& in, bool wheels_only) {
  std::vector<std::string> names = jointNames();
  if (wheels_only) names.resize(kWheelCount);
  return static_cast<int>(in.chooseIndex("joint", names));
}

const std::string& nameOf(int joint) { return jointNames()[static_cast<std::size_t>(joint)]; }

}  // namespace

std::string toText(const Fault& f) {
  switch (f.kind) {
    case Fault::Kind::kImuGap:
      return "imu_gap";
    case Fault::Kind::kEncoderStuck:
      return fmt::format("encoder_stuck {}", nameOf(f.joint));
    case Fault::Kind::kWheelSlip:
      return fmt::format("wheel_slip {}", nameOf(f.joint));
    case Fault::Kind::kDriveDead:
      return fmt::format("drive_dead {}", nameOf(f.joint));
    case Fault::Kind::kSpikes:
      break;
  }
  if (f.signal == Fault::Signal::kJoint) return fmt::format("spikes {}", nameOf(f.joint));
  return f.signal == Fault::Signal::kGyro ? "spikes gyro" : "spikes accel";
}

void Fault::describe(ConfigVisitor& v, FaultKeys keys) {
  v.choice(must("kind", "what goes wrong"), kind,
           {{"imu_gap", Kind::kImuGap},
            {"encoder_stuck", Kind::kEncoderStuck},
            {"spikes", Kind::kSpikes},
            {"wheel_slip", Kind::kWheelSlip},
            {"drive_dead", Kind::kDriveDead}});
  SimDuration since = start - kSimStart;
  v.duration(must("start_s", "when it sets in"), since, {0, 1e6});
  start = kSimStart + since;
  v.duration(must("duration_s", "how long it lasts"), duration, {kTiny, 1e6});

  // Where a kind needs a key it has to be there; among the keys of every kind it may be. So signal
  // and joint are no plain choices: those would have a default.
  const bool every = keys == FaultKeys::kOfEveryKind;
  const bool spikes = kind == Kind::kSpikes, slip = kind == Kind::kWheelSlip;
  if (every || spikes) {
    v.other({"signal", "of which single values are far off, with spikes", !every},
            "one of gyro, accel, joint_angle; needed with spikes", [&](ConfigReader& in) {
              signal = in.choice<Signal>("signal", {{"gyro", Signal::kGyro},
                                                    {"accel", Signal::kAccel},
                                                    {"joint_angle", Signal::kJoint}});
            });
  }
  static const std::string kinds = fmt::format(
      "one of {}; needed with encoder_stuck, drive_dead, wheel_slip (wheels only) and "
      "spikes of joint_angle",
      fmt::join(jointNames(), ", "));
  if (every || kind == Kind::kEncoderStuck || kind == Kind::kDriveDead || slip ||
      (spikes && signal == Signal::kJoint)) {
    v.other({"joint", "whose encoder is stuck or spoiled, whose drive is dead, or wheel that slips",
             !every},
            kinds.c_str(), [&](ConfigReader& in) { joint = readJoint(in, slip); });
  }
  if (every || spikes) {
    v.number(may("size_sigma", "of spikes, in standard deviations of the sensor's own noise"),
             size_sigma, {0, 1e6});
    v.number(may("share", "of the samples that spikes spoil"), share, {0, 1});
  }
  if (every || slip) {
    v.number(may("traction_Nm", "what a slipping wheel can still bring onto the ball"),
             traction_torque, {0, 10});
  }
}

void describeFaults(ConfigVisitor& v, std::vector<Fault>& faults, FaultKeys keys) {
  v.list(may("faults", "what goes wrong, each for some time"), [&](ConfigVisitor& in) {
    faults.emplace_back();
    faults.back().describe(in, keys);
  });
}

FaultInjector::FaultInjector(std::vector<Fault> faults, const SensorParameters& sensors,
                             std::uint64_t seed)
    : faults_(std::move(faults)),
      gyro_sigma_(sensors.imu.gyro_noise / std::sqrt(toSeconds(sensors.imu.period))),
      accel_sigma_(sensors.imu.accel_noise / std::sqrt(toSeconds(sensors.imu.period))),
      joint_sigma_(sensors.encoders.joint_resolution / std::sqrt(12.0)) {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    streams_.emplace_back(seed, fmt::format("fault.{}", i));
  }
}

bool FaultInjector::anySlip() const {
  return std::any_of(faults_.begin(), faults_.end(),
                     [](const Fault& f) { return f.kind == Fault::Kind::kWheelSlip; });
}

SimTime FaultInjector::nextChange(SimTime now) const {
  SimTime next = SimTime::max();
  for (const Fault& f : faults_) {
    if (f.start > now) next = std::min(next, f.start);
    if (f.end() > now) next = std::min(next, f.end());
  }
  return next;
}

Vector3 FaultInjector::traction(SimTime now) const {
  Vector3 out = Vector3::Constant(std::numeric_limits<double>::infinity());
  for (const Fault& f : faults_) {
    if (f.kind == Fault::Kind::kWheelSlip && f.activeAt(now)) {
      out[f.joint] = std::min(out[f.joint], f.traction_torque);
    }
  }
  return out;
}

void FaultInjector::cut(SimTime now, JointVector& motor_torque) const {
  for (const Fault& f : faults_) {
    if (f.kind == Fault::Kind::kDriveDead && f.activeAt(now)) motor_torque[f.joint] = 0;
  }
}

bool FaultInjector::stuck(SimTime now, int joint) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const Fault& f) {
    return f.kind == Fault::Kind::kEncoderStuck && f.joint == joint && f.activeAt(now);
  });
}

bool FaultInjector::gap(SimTime now) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const Fault& f) {
    return f.kind == Fault::Kind::kImuGap && f.activeAt(now);
  });
}

void FaultInjector::reset() {
  held_angle_.setZero();
  held_since_.setConstant(-1);
  delivered_ = Imu::Sample{};
}

void FaultInjector::arrive(SimTime now, const JointVector& joint_angle, const Imu::Sample& imu) {
  if (!gap(imu.time)) delivered_ = imu;
  for (int i = 0; i < kJointCount; ++i) {
    if (!stuck(now, i)) {
      held_since_[i] = -1;
    } else if (held_since_[i] < 0) {
      held_since_[i] = toSeconds(now);
      held_angle_[i] = joint_angle[i];
    }
  }
}

void FaultInjector::apply(SimTime now, SensorFrame& frame) const {
  frame.imu_count = delivered_.count;
  frame.imu_time = delivered_.time;
  frame.accel_B = delivered_.accel_B;
  frame.gyro_WB_B = delivered_.gyro_WB_B;
  for (int i = 0; i < kJointCount; ++i) {
    if (held_since_[i] < 0) continue;
    frame.joint_angle[i] = held_angle_[i];
    frame.joint_velocity[i] = 0;
  }
  for (std::size_t k = 0; k < faults_.size(); ++k) {
    const Fault& f = faults_[k];
    if (f.kind != Fault::Kind::kSpikes) continue;
    if (f.signal == Fault::Signal::kJoint) {
      if (f.activeAt(now)) frame.joint_angle[f.joint] += jointSpike(streams_[k], f, now);
    } else if (f.activeAt(frame.imu_time)) {
      Vector3& sample = f.signal == Fault::Signal::kGyro ? frame.gyro_WB_B : frame.accel_B;
      sample += imuSpike(streams_[k], f, frame.imu_count);
    }
  }
}

double FaultInjector::jointSpike(const RandomStream& stream, const Fault& f, SimTime now) const {
  const auto u = stream.uniforms(static_cast<std::uint64_t>(toNs(now)));
  if (u[0] >= f.share) return 0;
  return (u[1] < 0.5 ? -1 : 1) * f.size_sigma * joint_sigma_;
}

Vector3 FaultInjector::imuSpike(const RandomStream& stream, const Fault& f,
                                std::int64_t count) const {
  const auto index = static_cast<std::uint64_t>(count);
  if (stream.uniforms(index)[0] >= f.share) return Vector3::Zero();
  const auto n = stream.normals(index, 1);
  const double sigma = f.signal == Fault::Signal::kGyro ? gyro_sigma_ : accel_sigma_;
  return f.size_sigma * sigma * Vector3(n[0], n[1], n[2]).normalized();
}

}  // namespace ballbot
