#pragma once

#include <cstdint>
#include <optional>

#include "core/time.hpp"
#include "model/robot_parameters.hpp"
#include "model/robot_reader.hpp"
#include "plant/added_sensors.hpp"
#include "plant/environment.hpp"
#include "plant/faults.hpp"
#include "plant/motion_capture.hpp"
#include "plant/multibody.hpp"
#include "plant/sensors.hpp"
#include "plant/slope.hpp"
#include "plant/spin_friction.hpp"
#include "plant/surroundings.hpp"

namespace ballbot {

class ConfigNode;
class ConfigVisitor;

enum class ActuatorLevel { kIdeal, kSeriesElastic };
enum class ContactLevel { kRolling, kRollingWithSpinFriction, kCompliant };

/// How true to the robot the plant is; each switch can be changed alone.
/// docs/fidelity.md says what each one adds.
struct PlantFidelity {
  MultibodyStructure multibody = MultibodyStructure::kFull;
  ActuatorLevel actuators = ActuatorLevel::kSeriesElastic;
  ContactLevel contact = ContactLevel::kRolling;
  bool wheels_slip = false;  ///< on the ball, where their normal force holds them no longer
  bool noisy_sensors = true;
  bool encoder_quantisation = true;  ///< takes effect with noisy sensors
  bool friction = true;              ///< takes effect with series elastic actuators
  bool saturation = true;
  bool speed_limit = true;
  bool transport_delay = true;

  void describe(ConfigVisitor& v);
};

/// A gain and a delay put into the loop at the wheel torques, to find out how much of either the
/// loop can take. Neither is part of a robot.
struct LoopInsertion {
  double gain = 1;
  int delay_ticks = 0;  ///< ticks of the drives

  void describe(ConfigVisitor& v);
  bool present() const { return gain != 1 || delay_ticks > 0; }
};

/// Where the robot starts, at rest. A stand holds ball, base, wheels and arm until `release`.
struct InitialCondition {
  RobotPose pose;
  SimTime release{};

  /// @param robot  within whose limits the arm has to be
  void describe(ConfigVisitor& v, const RobotParameters& robot);
};

/// Everything the plant is made of.
struct PlantConfig {
  RobotParameters robot;  ///< as the plant has it: mismatch and payload included
  RobotActuators actuators;
  SensorParameters sensors;
  PlantFidelity fidelity;
  SpinFriction spin_friction;
  FloorContactParameters floor;  ///< of a compliant contact
  WheelContactParameters wheel_contact;
  double integration_tolerance = 1e-6;        ///< of a compliant contact, per step
  SimDuration substep{400'000};               ///< longest integration step
  SimDuration drive_period{400'000};          ///< of the drives' torque loops
  int transport_delay_ticks = 2;              ///< drive ticks from command to drive
  bool leak_compensation = false;             ///< of the drives, docs/theory/actuator.md
  Vector3 base_com_offset = Vector3::Zero();  ///< that `robot` has from this section [m]
  LoopInsertion wheel_loop;  ///< between the wheels' wanted torque and their torque loop
  InitialCondition initial;
  std::vector<Push> pushes;
  std::vector<Fault> faults;
  SurroundingsParameters surroundings;
  Slope slope;
  std::optional<MotionCaptureParameters> motion_capture;
  AddedSensorList added_sensors;
  std::uint64_t seed = 1;

  /// Whether the truth knows how the wheels stand on the ball.
  bool knowsWheels() const { return fidelity.wheels_slip || wheel_contact.recorded; }
};

/// Reads the sections robot, plant, initial and environment and the seed of a scenario. Other
/// sections are left to those who use them.
/// @throw InputError with file, line and column.
PlantConfig readPlantConfig(const ConfigNode& scenario);
/// The same of a scenario whose robot is read already.
PlantConfig readPlantConfig(const ConfigNode& scenario, const RobotParameters& robot);

/// All keys that are read of the sections `plant:`, `initial:` and `environment:` and of the
/// `sensors:` of `robot:`, with their defaults; for references and the like.
void describePlant(ConfigVisitor& v);
void describeInitial(ConfigVisitor& v);
void describeEnvironment(ConfigVisitor& v);
void describeSensors(ConfigVisitor& v);

}  // namespace ballbot
