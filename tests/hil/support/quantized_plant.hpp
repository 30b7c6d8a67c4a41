#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "cosim/participant.hpp"

namespace ballbot {

/// The plant with nothing between it and the controller but what a bench cannot avoid: torque and
/// measurements in whole counts, torque that grows over a ramp, and, where outputs are synchronous,
/// a cycle of delay. Written from docs/hil.md, not with the bench's code.
class QuantizedPlant final : public Participant {
 public:
  QuantizedPlant(std::unique_ptr<Participant> plant, int ramp_cycles, bool delayed)
      : plant_(std::move(plant)), ramp_(ramp_cycles), delayed_(delayed) {}

  std::string name() const override { return plant_->name(); }
  void enterInitializationMode(SimTime start) override {
    plant_->enterInitializationMode(start);
    plant_->exitInitializationMode();
    read();
  }
  void exitInitializationMode() override {}
  void doStep(SimTime now, SimDuration step, const ActuatorCommand& command) override {
    ActuatorCommand counted;
    const double share = cycles_ + 1 < ramp_ ? static_cast<double>(cycles_ + 1) / ramp_ : 1.0;
    ++cycles_;
    for (int i = 0; i < kJointCount; ++i) {
      const auto per_mille = std::llround(command.torque[i] * share / (20.0 / 1000));
      counted.torque[i] = static_cast<double>(per_mille) * (20'000 * 1e-3 / 1000);
    }
    plant_->doStep(now, step, delayed_ ? last_ : counted);
    last_ = counted;
    read();
  }
  void terminate() override { plant_->terminate(); }
  void reset() override { plant_->reset(); }
  const SensorFrame& sensors() const override { return sensors_; }
  std::optional<TruthFrame> truth() const override { return plant_->truth(); }
  StateBlob saveState() const override { return plant_->saveState(); }
  void restoreState(const StateBlob& blob) override { plant_->restoreState(blob); }
  std::uint64_t stateDigest() const override { return plant_->stateDigest(); }

 private:
  static double counted(double value, double unit) {
    return unit * static_cast<double>(std::llround(value / unit));
  }
  void read() {
    constexpr double kTurn = 6.283185307179586476925;
    sensors_ = plant_->sensors();
    for (int i = 0; i < kJointCount; ++i) {
      sensors_.joint_angle[i] = counted(sensors_.joint_angle[i], kTurn / 14'400);
      sensors_.motor_angle[i] = counted(sensors_.motor_angle[i], kTurn / 720'000);
      sensors_.joint_velocity[i] = counted(sensors_.joint_velocity[i], kTurn / 14'400);
      sensors_.joint_torque[i] = counted(sensors_.joint_torque[i], 20.0 / 1000);
    }
    for (int i = 0; i < 3; ++i) {
      sensors_.accel_B[i] = counted(sensors_.accel_B[i], 4.79e-3);
      sensors_.gyro_WB_B[i] = counted(sensors_.gyro_WB_B[i], 1.065e-3);
    }
  }

  std::unique_ptr<Participant> plant_;
  int ramp_;
  bool delayed_;
  int cycles_ = 0;
  ActuatorCommand last_;
  SensorFrame sensors_;
};

}  // namespace ballbot
