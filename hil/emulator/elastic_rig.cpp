#include "hil/emulator/elastic_rig.hpp"

#include <string>

#include <fmt/format.h>

#include "core/digest.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr std::int64_t kImuPeriod = 2'500'000, kTickNs = 100'000;
// Standard deviations of a sample, those of the robot's IMU.
constexpr double kGyroNoise = 2.4e-3, kAccelNoise = 0.024;  // [rad/s], [m/s^2]

}  // namespace

ElasticRig::ElasticRig(const ElasticRigOptions& options)
    : options_(options),
      gyro_noise_(options.noise_seed, "rig.gyro_noise"),
      accel_noise_(options.noise_seed, "rig.accel_noise") {
  for (int i = 0; i < kJointCount; ++i) {
    joints_.emplace_back(options.joint);
    joints_.back().setOutput(options.output);
    joint_noise_.emplace_back(options.noise_seed, "rig.joint_noise." + std::to_string(i));
  }
}

void ElasticRig::enterInitializationMode(SimTime start) {
  *this = ElasticRig(options_);
  sensors_.time = sensors_.imu_time = start;
  sensors_.imu_count = 1;
  sampleJoints();
  sampleImu();
}

void ElasticRig::sampleImu() {
  const auto n = static_cast<std::uint64_t>(sensors_.imu_count);
  const auto accel = accel_noise_.normals(n), gyro = gyro_noise_.normals(n);
  sensors_.accel_B << kAccelNoise * accel[0], kAccelNoise * accel[1], 9.81;
  sensors_.gyro_WB_B << kGyroNoise * gyro[0], kGyroNoise * gyro[1], kGyroNoise * gyro[2];
}

// The drive's torque comes from its encoders, so it has their noise.
void ElasticRig::sampleJoints() {
  const ElasticJointParameters& p = options_.joint;
  for (int i = 0; i < kJointCount; ++i) {
    const ElasticJoint& joint = joints_[index(i)];
    const auto noise = joint_noise_[index(i)].normals(samples_);
    sensors_.joint_angle[i] = joint.jointAngle() + p.joint_angle_noise * noise[0];
    sensors_.motor_angle[i] = joint.motorAngle() + p.motor_angle_noise * noise[1];
    sensors_.joint_velocity[i] = joint.jointVelocity();
    sensors_.joint_torque[i] =
        p.actuator.spring_stiffness * (sensors_.motor_angle[i] - sensors_.joint_angle[i]);
    motor_torque_[i] = joint.meanMotorTorque() + p.motor_torque_noise * noise[2];
  }
  ++samples_;
}

void ElasticRig::doStep(SimTime now, SimDuration step, const ActuatorCommand& c) {
  if (step.count() % kTickNs != 0) {
    throw InputError(
        fmt::format("rig: a cycle of {} us is no whole number of the drives' ticks of "
                    "100 us; choose cycle_us accordingly",
                    1e-3 * static_cast<double>(step.count())));
  }
  for (int i = 0; i < kJointCount; ++i) {
    joints_[index(i)].advance(
        toSeconds(step), {c.torque[i], c.position[i], c.velocity[i], c.stiffness[i], c.damping[i]});
  }
  sensors_.time = now + step;
  sampleJoints();
  const std::int64_t samples = toNs(sensors_.time) / kImuPeriod + 1;
  if (samples == sensors_.imu_count) return;
  sensors_.imu_time = sensors_.time;
  sensors_.imu_count = samples;
  sampleImu();
}

StateBlob ElasticRig::saveState() const {
  throw CallOrderError("any", "saveState", "rig: the state of a test rig is not saved");
}
void ElasticRig::restoreState(const StateBlob&) { saveState(); }

std::uint64_t ElasticRig::stateDigest() const {
  Digest digest;
  for (const ElasticJoint& joint : joints_) {
    for (const double v : {joint.motorAngle(), joint.jointAngle(), joint.jointVelocity(),
                           joint.springTorque(), joint.meanMotorTorque()}) {
      digest.add(&v, sizeof v);
    }
  }
  return digest.low64();
}

}  // namespace ballbot
