#include "model/robot_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/config_visitor.hpp"
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

/// What the `robot:` section itself holds, beside the URDF that it names.
struct RobotFile {
  std::string urdf;
  RobotLinks links;
  double gravity = 9.81, total_mass = 0, payload_mass = 0;
  double wheel_radius = 0, contact_zenith = 0;
  std::array<double, kWheelCount> azimuth{};
  double wheel_friction = kUnlimited;
  double slide_lead = kSlideLead;
  std::array<double, kArmJointCount> nominal_arm{};
  double wheel_torque_limit = 0, arm_torque_limit = 0;

  void describe(ConfigVisitor& v) {
    v.text(must("urdf", "file with the bodies, beside the one that names it"), urdf);
    v.section(may("links", "what the URDF calls the parts of the robot"),
              [this](ConfigVisitor& in) { links.describe(in); });
    v.number(must("gravity_m_per_s2", "acceleration of free fall"), gravity, {0.1, 100});
    v.section(must("wheels", "where the wheels touch the ball"), [this](ConfigVisitor& wheels) {
      wheels.number(must("radius_m", "of a wheel"), wheel_radius, {kTiny, kInf});
      wheels.number(must("contact_zenith_deg", "angle of the contacts from the ball's top"),
                    contact_zenith, {1, 89}, kRadPerDeg);
      wheels.vector(must("azimuth_deg", "of each wheel about the vertical, from ahead"), azimuth,
                    {-360, 360}, kRadPerDeg);
      wheels.number(
          may("friction",
              "largest force along a wheel's direction of driving per normal force; "
              "without it, and from 1e6 on, wheels are taken to hold whatever they are asked for"),
          wheel_friction, {kTiny, kUnlimited});
    });
    v.number(may("slide_lead_m_per_rad",
                 "way of an arm joint that slides per angle of its drive, behind the gear; such a "
                 "joint counts by that angle"),
             slide_lead, {1e-4, 10});
    v.number(must("total_mass_kg", "of all links, a check on the URDF"), total_mass, {kTiny, kInf});
    v.number(may("payload_mass_kg", "point mass at the end-effector"), payload_mass, {0, 100});
    v.vector(must("nominal_arm_rad", "angles of the arm at rest"), nominal_arm);
    v.number(must("wheel_torque_limit_Nm", "what is asked of a wheel at most"), wheel_torque_limit,
             {kTiny, kInf});
    v.number(must("arm_torque_limit_Nm", "what is asked of an arm joint at most"), arm_torque_limit,
             {kTiny, kInf});
  }
};

/// Whoever has an arm of another size wants another program, not another file.
void requireArmSize(ConfigReader& in) {
  if (!in.has("nominal_arm_rad")) return;
  const std::size_t joints = in.raw("nominal_arm_rad")->items().size();
  if (joints == kArmJointCount || joints < 2 || joints > kMaxArmJoints) return;
  throw InputError(
      fmt::format("{} has {} values, but this program is built for arms of {} joints. "
                  "docs/robot.md says how to "
                  "build one for {}: cmake -DBALLBOT_ARM_JOINTS={}",
                  in.at("nominal_arm_rad"), joints, kArmJointCount, joints, joints));
}

/// URDF and YAML both say where the wheels are; a robot whose picture and equations differ would
/// be found out late.
void checkWheelPlacement(const UrdfRobot& urdf, const RobotLinks& links,
                         const RobotParameters& robot, const std::string& where) {
  for (int i = 0; i < kWheelCount; ++i) {
    const Vector3 centre = robot.wheelCentre(i), axle = robot.wheelAxle(i);
    if ((centre - urdf.wheel_centre[i]).norm() > kSameLength_m ||
        (axle - urdf.wheel_axle[i]).norm() > kSameLength_m) {
      throw InputError(fmt::format(
          "{} contradicts the URDF: link '{}' is at ({:.6f}, {:.6f}, {:.6f}) with axle "
          "({:.6f}, {:.6f}, {:.6f}) there, must be at ({:.6f}, {:.6f}, {:.6f}) with axle ({:.6f}, "
          "{:.6f}, {:.6f})",
          where, links.wheels[static_cast<std::size_t>(i)], urdf.wheel_centre[i].x(),
          urdf.wheel_centre[i].y(), urdf.wheel_centre[i].z(), urdf.wheel_axle[i].x(),
          urdf.wheel_axle[i].y(), urdf.wheel_axle[i].z(), centre.x(), centre.y(), centre.z(),
          axle.x(), axle.y(), axle.z()));
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
  requireArmSize(in);
  RobotFile file;
  readDescribed(in, file);
  const std::string path = urdfPath(*in.raw("urdf"));
  const UrdfRobot urdf = loadUrdf(path, file.links, file.slide_lead);
  RobotParameters robot = urdf.parameters;

  robot.gravity = file.gravity;
  robot.wheels.radius = file.wheel_radius;
  robot.wheels.contact_zenith = file.contact_zenith;
  robot.wheels.azimuth = file.azimuth;
  robot.wheels.friction = file.wheel_friction;
  checkApart(robot.wheels.azimuth, in.child("wheels").at("azimuth_deg"));
  checkWheelPlacement(urdf, file.links, robot, in.at("wheels"));

  if (std::abs(robot.totalMass() - file.total_mass) > 1e-6 * file.total_mass) {
    throw InputError(fmt::format("{} is {}, but the links of {} sum to {:.9g} kg",
                                 in.at("total_mass_kg"), file.total_mass, path, robot.totalMass()));
  }
  robot.payload_mass = file.payload_mass;

  for (int i = 0; i < kArmJointCount; ++i) {
    const ArmLink& link = robot.arm[i];
    const double angle = file.nominal_arm[static_cast<std::size_t>(i)];
    if (angle < link.lower_limit || angle > link.upper_limit) {
      throw InputError(
          fmt::format("{} puts joint {} at {} rad, must be between {} and {} (link "
                      "'{}' of {})",
                      in.at("nominal_arm_rad"), i + 1, angle, link.lower_limit, link.upper_limit,
                      link.name, path));
    }
    robot.nominal_arm[i] = angle;
  }
  robot.wheel_torque_limit = std::min(file.wheel_torque_limit, kUnlimited);
  robot.arm_torque_limit = std::min(file.arm_torque_limit, kUnlimited);

  if (in.has("actuators")) {
    const RobotActuators actuators = readActuators(in);
    checkDriveAgreement(urdf, actuators, in);
    robot.wheel_speed_limit = actuators.wheel.speed_limit;
  }
  in.raw("sensors");
  in.finish();
  return robot;
}

void RobotActuators::describe(ConfigVisitor& v) {
  v.section(must("wheel", "drive of each wheel"),
            [this](ConfigVisitor& in) { wheel.describe(in); });
  v.section(must("arm", "drive of each arm joint"),
            [this](ConfigVisitor& in) { arm.describe(in); });
}

void describeRobot(ConfigVisitor& v) {
  RobotFile().describe(v);
  v.section(may("actuators", "figures of the drives; without, they are ideal"),
            [](ConfigVisitor& in) { RobotActuators().describe(in); });
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
