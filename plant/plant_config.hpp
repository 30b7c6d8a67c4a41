#pragma once

#include <cstdint>
#include <optional>

#include "core/time.hpp"
#include "model/robot_parameters.hpp"
#include "model/robot_reader.hpp"
#include "plant/environment.hpp"
#include "plant/faults.hpp"
#include "plant/motion_capture.hpp"
#include "plant/multibody.hpp"
#include "plant/sensors.hpp"
#include "plant/surroundings.hpp"

namespace ballbot {

class ConfigNode;
class ConfigReader;

enum class ActuatorLevel { kIdeal, kSeriesElastic };
enum class ContactLevel { kRolling, kRollingWithSpinFriction };

/// How true to the robot the plant is; each switch is independent of the others.
/// docs/fidelity.md says what each one adds.
struct PlantFidelity {
  MultibodyStructure multibody = MultibodyStructure::kFull;
  ActuatorLevel actuators = ActuatorLevel::kSeriesElastic;
  ContactLevel contact = ContactLevel::kRolling;
  bool noisy_sensors = true;
  bool encoder_quantisation = true;  ///< takes effect with noisy sensors
  bool friction = true;
  bool saturation = true;
  bool speed_limit = true;
  bool transport_delay = true;
};

/// Friction torque of the floor on the ball's spin s about the vertical: -torque tanh(s /
/// smoothing).
struct SpinFriction {
  double torque = 0.4;      ///< [N m]
  double smoothing = 0.02;  ///< [rad/s]
};

/// Where the robot starts, at rest. A stand holds ball, base, wheels and arm until `release`.
struct InitialCondition {
  RobotPose pose;
  SimTime release{};
};

/// Everything the plant is made of.
struct PlantConfig {
  RobotParameters robot;  ///< as the plant has it: mismatch and payload included
  RobotActuators actuators;
  SensorParameters sensors;
  PlantFidelity fidelity;
  SpinFriction spin_friction;
  SimDuration substep{400'000};       ///< longest integration step
  SimDuration drive_period{400'000};  ///< of the drives' torque loops
  int transport_delay_ticks = 2;      ///< drive ticks from command to drive
  bool leak_compensation = false;     ///< of the drives, docs/theory/actuator.md
  InitialCondition initial;
  std::vector<Push> pushes;
  std::vector<Fault> faults;
  SurroundingsParameters surroundings;
  std::optional<MotionCaptureParameters> motion_capture;
  std::uint64_t seed = 1;
};

/// Reads the sections robot, plant, initial and environment and the seed of a scenario. Other
/// sections are left to those who use them.
/// @throw InputError with file, line and column.
PlantConfig readPlantConfig(const ConfigNode& scenario);

}  // namespace ballbot
