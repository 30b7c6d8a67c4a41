#include "model/robot_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "model/drive_agreement.hpp"
#include "model/limits.hpp"
#include "model/urdf_loader.hpp"

namespace ballbot {
namespace {

constexpr double kSameLength_m = 1e-6;
constexpr double kLeastApart_deg = 5;  ///< wheels closer than this would be one inside the other

/// Two wheels in one direction leave the ball a way that no wheel drives.
void checkApart(const std::array<double, kWheelCount>& azimuth, const std::string& where) {
  for (int i = 0; i < kWheelCount; ++i) {
    for (int j = 0; j < i; ++j) {
      const double apart_deg =
          std::abs(std::remainder(azimuth[i] - azimuth[j], kTwoPi)) * kDegPerRad;
      if (apart_deg >= kLeastApart_deg) continue;
      throw InputError(
          fmt::format("{} puts wheels {} and {} {:.3g} degrees apart, must be at least "
                      "{}: three wheels drive the ball in three ways",
                      where, j + 1, i + 1, apart_deg, kLeastApart_deg));
    }
  }
}

void readWheels(ConfigReader in, RobotParameters::Wheels& wheels) {
  wheels.radius = in.number("radius_m", {kTiny, kInf});
  wheels.contact_zenith = kRadPerDeg * in.number("contact_zenith_deg", {1, 89});
  wheels.azimuth = in.numbers<kWheelCount>("azimuth_deg", {-360, 360});
  for (double& azimuth : wheels.azimuth) azimuth *= kRadPerDeg;
  checkApart(wheels.azimuth, in.at("azimuth_deg"));
  in.finish();
}

/// URDF and YAML both say where the wheels are; a robot whose picture and equations differ would
/// be found out late.
void checkWheelPlacement(const UrdfRobot& urdf, const RobotParameters& robot,
                         const std::string& where) {
  for (int i = 0; i < kWheelCount; ++i) {
    const Vector3 centre = robot.wheelCentre(i), axle = robot.wheelAxle(i);
    if ((centre - urdf.wheel_centre[i]).norm() > kSameLength_m ||
        (axle - urdf.wheel_axle[i]).norm() > kSameLength_m) {
      throw InputError(fmt::format(
          "{} contradicts the URDF: link 'wheel_{}' is at ({:.6f}, {:.6f}, {:.6f}) with axle "
          "({:.6f}, {:.6f}, {:.6f}) there, must be at ({:.6f}, {:.6f}, {:.6f}) with axle ({:.6f}, "
          "{:.6f}, {:.6f})",
          where, i + 1, urdf.wheel_centre[i].x(), urdf.wheel_centre[i].y(),
          urdf.wheel_centre[i].z(), urdf.wheel_axle[i].x(), urdf.wheel_axle[i].y(),
          urdf.wheel_axle[i].z(), centre.x(), centre.y(), centre.z(), axle.x(), axle.y(),
          axle.z()));
    }
  }
}

}  // namespace

std::string urdfPath(const ConfigNode& urdf) {
  const std::filesystem::path file = urdf.text();
  const std::string& source = urdf.where().source;
  const bool command_line = source.rfind("--", 0) == 0;
  if (file.is_absolute() || command_line) return file.string();
  return (std::filesystem::path(source).parent_path() / file).lexically_normal().string();
}

RobotParameters readRobot(ConfigReader& in) {
  in.text("urdf");  // checks that it is there and a text
  const std::string path = urdfPath(*in.raw("urdf"));
  const UrdfRobot urdf = loadUrdf(path);
  RobotParameters robot = urdf.parameters;

  robot.gravity = in.number("gravity_m_per_s2", {0.1, 100});
  readWheels(in.child("wheels"), robot.wheels);
  checkWheelPlacement(urdf, robot, in.at("wheels"));

  const double total = in.number("total_mass_kg", {kTiny, kInf});
  if (std::abs(robot.totalMass() - total) > 1e-6 * total) {
    throw InputError(fmt::format("{} is {}, but the links of {} sum to {:.9g} kg",
                                 in.at("total_mass_kg"), total, path, robot.totalMass()));
  }
  robot.payload_mass = in.numberOr("payload_mass_kg", 0, {0, 100});

  const auto arm = in.numbers<kArmJointCount>("nominal_arm_rad");
  for (int i = 0; i < kArmJointCount; ++i) {
    const ArmLink& link = robot.arm[i];
    if (arm[i] < link.lower_limit || arm[i] > link.upper_limit) {
      throw InputError(
          fmt::format("{} puts joint {} at {} rad, must be between {} and {} (link "
                      "'{}' of {})",
                      in.at("nominal_arm_rad"), i + 1, arm[i], link.lower_limit, link.upper_limit,
                      link.name, path));
    }
    robot.nominal_arm[i] = arm[i];
  }
  const auto torqueLimit = [&](const char* key) {
    return std::min(in.number(key, {kTiny, kInf}), kUnlimited);
  };
  robot.wheel_torque_limit = torqueLimit("wheel_torque_limit_Nm");
  robot.arm_torque_limit = torqueLimit("arm_torque_limit_Nm");

  if (in.has("actuators")) {
    const RobotActuators actuators = readActuators(in);
    checkDriveAgreement(urdf, actuators, in);
    robot.wheel_speed_limit = actuators.wheel.speed_limit;
  }
  in.raw("sensors");
  in.finish();
  return robot;
}

RobotActuators readActuators(ConfigReader& robot) {
  ConfigReader in = robot.child("actuators");
  RobotActuators actuators;
  ConfigReader wheel = in.child("wheel");
  actuators.wheel = ActuatorParameters::read(wheel);
  ConfigReader arm = in.child("arm");
  actuators.arm = ActuatorParameters::read(arm);
  in.finish();
  return actuators;
}

}  // namespace ballbot
