#include "plant/drive_bank.hpp"

#include <algorithm>

#include "plant/plant_config.hpp"

namespace ballbot {

DriveBank::DriveBank(const PlantConfig& config)
    : encoders_(config.sensors.encoders,
                !config.fidelity.noisy_sensors || !config.fidelity.encoder_quantisation,
                config.drive_period),
      on_the_way_(1 + (config.fidelity.transport_delay ? config.transport_delay_ticks : 0)),
      inserted_gain_(config.wheel_loop.gain),
      inserted_delay_(config.wheel_loop.delay_ticks > 0 ? 1 + config.wheel_loop.delay_ticks : 0,
                      Vector3::Zero()) {
  DriveOptions options;
  options.torque_loop = config.fidelity.actuators == ActuatorLevel::kSeriesElastic;
  options.saturation = config.fidelity.saturation;
  options.leak_compensation = config.leak_compensation;
  options.period = config.drive_period;
  for (int i = 0; i < kJointCount; ++i) drives_.emplace_back(config.actuators.of(i), options);
}

void DriveBank::reset(const JointMotion& motion) {
  encoders_.reset(motion);
  for (TorqueDrive& drive : drives_) drive.reset();
  ticks_ = 0;
  std::fill(on_the_way_.begin(), on_the_way_.end(), ActuatorCommand{});
  std::fill(inserted_delay_.begin(), inserted_delay_.end(), Vector3::Zero());
}

JointVector DriveBank::act(const ActuatorCommand& command) {
  const auto slots = static_cast<std::int64_t>(on_the_way_.size());
  on_the_way_[ticks_ % slots] = command;
  ++ticks_;
  const ActuatorCommand& arrived = on_the_way_[ticks_ % slots];  // the oldest
  const JointReadings& r = encoders_.readings();
  const auto reading = [&](int i) {
    return DriveReading{r.motor_angle[i], r.motor_velocity[i], r.joint_angle[i],
                        r.joint_velocity[i]};
  };
  JointVector wanted, demand;
  for (int i = 0; i < kJointCount; ++i) {
    wanted[i] =
        TorqueDrive::wantedTorque({arrived.torque[i], arrived.position[i], arrived.velocity[i],
                                   arrived.stiffness[i], arrived.damping[i]},
                                  reading(i));
  }
  passInsertion(wanted);
  for (int i = 0; i < kJointCount; ++i) demand[i] = drives_[i].tick(wanted[i], reading(i));
  return demand;
}

void DriveBank::passInsertion(JointVector& wanted) {
  auto wheels = wanted.head<kWheelCount>();
  wheels *= inserted_gain_;
  if (inserted_delay_.empty()) return;
  const auto slots = static_cast<std::int64_t>(inserted_delay_.size());
  inserted_delay_[(ticks_ - 1) % slots] = wheels;
  wheels = inserted_delay_[ticks_ % slots];  // the oldest
}

}  // namespace ballbot
