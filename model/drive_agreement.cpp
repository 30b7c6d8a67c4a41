#include "model/drive_agreement.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/config_reader.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr double kSameRatio = 1e-6;

/// One value of a URDF's joint, and the key that says the same of the drive.
struct Claim {
  const char* what;
  std::optional<double> urdf;
  const char* key;
  double simulated;
  bool is_limit;  ///< kept by whatever is not above it
};

bool agree(const Claim& c) {
  if (!c.urdf) return true;
  if (c.is_limit) return c.simulated <= *c.urdf * (1 + kSameRatio);
  return std::abs(c.simulated - *c.urdf) <= kSameRatio * std::abs(c.simulated);
}

void checkJoint(const UrdfDrive& urdf, const ActuatorParameters& p, const ConfigReader& actuator) {
  const Claim claims[] = {
      {"effort [N m]", urdf.effort, "peak_torque_Nm", p.peak_torque, true},
      {"velocity [rad/s]", urdf.velocity, "speed_limit_rad_per_s", p.speed_limit, true},
      {"damping [N m s/rad]", urdf.damping, "viscous_friction_Nms_per_rad", p.viscous_friction,
       false},
      {"friction [N m]", urdf.dry_friction, "static_friction_Nm", p.static_friction, false}};
  for (const Claim& c : claims) {
    if (agree(c)) continue;
    throw InputError(fmt::format(
        "{} has {} = {}, but {} is {}, and that is what is simulated. Make it {}, or change the "
        "URDF",
        urdf.where, c.what, *c.urdf, actuator.at(c.key), c.simulated,
        c.is_limit ? "no more than the URDF allows" : "the same"));
  }
}

}  // namespace

void checkDriveAgreement(const UrdfRobot& urdf, const RobotActuators& actuators,
                         ConfigReader& robot) {
  ConfigReader groups = robot.child("actuators");
  const ConfigReader wheel = groups.child("wheel"), arm = groups.child("arm");
  for (int i = 0; i < kJointCount; ++i) {
    checkJoint(urdf.drives[i], actuators.of(i), i < kWheelCount ? wheel : arm);
  }
}

}  // namespace ballbot
