#include "survey/robot_draft.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "core/yaml_text.hpp"
#include "model/limits.hpp"
#include "model/urdf_loader.hpp"

namespace ballbot {
namespace {

constexpr double kSameLength_m = 1e-6;
constexpr double kFriction = 0.6;      // of rubber rollers on a ball, with something to spare
constexpr double kGravity = 9.81;      // [m/s^2]
constexpr double kArmTorque_Nm = 18;   // where the URDF says none
constexpr double kSaysNothing = 1e-3;  // a limit of zero means that nobody filled it in

/// What the wheels' places say; alike for all three.
struct Wheels {
  double radius, zenith;
  std::vector<double> azimuth_deg;
};

Wheels wheelsOf(const UrdfRobot& urdf, const RobotLinks& links, const std::string& path) {
  Wheels out{};
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const Vector3& c = urdf.wheel_centre[i];
    const double radius = c.norm() - urdf.parameters.ball.radius;
    const double zenith = std::atan2(c.head<2>().norm(), c.z());
    if (i == 0) {
      out.radius = radius;
      out.zenith = zenith;
    }
    if (!(radius > 0)) {
      throw InputError(
          fmt::format("{}: the centre of link '{}' is {:.4g} m from the ball's, inside "
                      "the ball, whose radius is {:.4g} m",
                      path, links.wheels[i], c.norm(), urdf.parameters.ball.radius));
    }
    if (std::abs(radius - out.radius) > kSameLength_m ||
        std::abs(zenith - out.zenith) * c.norm() > kSameLength_m) {
      throw InputError(fmt::format(
          "{}: link '{}' is {:.6g} m from the ball's centre at {:.6g} degrees from its top, '{}' "
          "is "
          "{:.6g} m at {:.6g} degrees; wheels of different size or height are not simulated",
          path, links.wheels[i], c.norm(), zenith * kDegPerRad, links.wheels[0],
          urdf.wheel_centre[0].norm(), out.zenith * kDegPerRad));
    }
    out.azimuth_deg.push_back(std::atan2(c.y(), c.x()) * kDegPerRad);
  }
  return out;
}

/// The strictest limit of these drives; kUnlimited where none says any.
double least(const UrdfRobot& urdf, int first, int count, std::optional<double> UrdfDrive::*limit) {
  double out = kUnlimited;
  for (int i = first; i < first + count; ++i) {
    const auto& value = urdf.drives[static_cast<std::size_t>(i)].*limit;
    if (value && *value > kSaysNothing) out = std::min(out, *value);
  }
  return out;
}

std::string linksText(const RobotLinks& links) {
  const std::vector<std::string> roles = RobotLinks().all(), names = links.all();
  std::vector<std::string> changed;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (names[i] != roles[i]) changed.push_back(roles[i] + ": " + yamlText(names[i]));
  }
  return changed.empty() ? "" : fmt::format("{{{}}}", fmt::join(changed, ", "));
}

}  // namespace

RobotDraft::RobotDraft(const std::string& path, const RobotLinks& links) : urdf_(path) {
  const UrdfRobot urdf = loadUrdf(path, links);
  const RobotParameters& robot = urdf.parameters;
  const Wheels wheels = wheelsOf(urdf, links, path);
  const double normal =
      (robot.totalMass() - robot.ball.mass) * kGravity / (kWheelCount * std::cos(wheels.zenith));
  const double traction = kFriction * normal * wheels.radius;
  const double wheel_effort = least(urdf, 0, kWheelCount, &UrdfDrive::effort);
  const double arm_effort = least(urdf, kWheelCount, kArmJointCount, &UrdfDrive::effort);
  std::vector<double> arm;
  for (const ArmLink& link : robot.arm) {
    arm.push_back(std::clamp(0.0, link.lower_limit, link.upper_limit));
  }
  if (const std::string names = linksText(links); !names.empty()) {
    keys_.push_back({"links", names, ""});
  }
  const auto number = [this](const char* key, double value, const char* words) {
    keys_.push_back({key, fmt::format("{:.12g}", value), words});
  };
  number("total_mass_kg", robot.totalMass(), "sum of the URDF's links");
  number("payload_mass_kg", 0, "");
  keys_.push_back(
      {"wheels",
       fmt::format("{{radius_m: {:.12g}, contact_zenith_deg: {:.12g}, azimuth_deg: "
                   "[{:.12g}]}}",
                   wheels.radius, wheels.zenith * kDegPerRad, fmt::join(wheels.azimuth_deg, ", ")),
       "radius: what is between their centres and the ball"});
  keys_.push_back({"nominal_arm_rad", fmt::format("[{:.6g}]", fmt::join(arm, ", ")),
                   "as near to zero as the limits allow: choose your own"});
  number("wheel_torque_limit_Nm", std::min(traction, wheel_effort),
         "traction at mu = 0.6, or the drive");
  number("arm_torque_limit_Nm", arm_effort < kUnlimited ? arm_effort : kArmTorque_Nm,
         arm_effort < kUnlimited ? "the URDF's" : "a guess: the URDF says none");
  addDrives("wheel", wheel_effort, least(urdf, 0, kWheelCount, &UrdfDrive::velocity));
  addDrives("arm", arm_effort, least(urdf, kWheelCount, kArmJointCount, &UrdfDrive::velocity));
}

void RobotDraft::addDrives(const char* group, double torque, double speed) {
  const auto limit = [&](const char* key, double value) {
    if (value >= kUnlimited) return;
    drives_.push_back(
        {fmt::format("actuators.{}.{}", group, key), fmt::format("{:.12g}", value), ""});
  };
  limit("peak_torque_Nm", torque);
  limit("speed_limit_rad_per_s", speed);
}

ConfigNode RobotDraft::laidOn(ConfigNode description) const {
  applyOverride(description, "urdf=" + yamlText(urdf_));
  for (const auto* keys : {&keys_, &drives_}) {
    for (const Key& key : *keys) applyOverride(description, key.path + "=" + key.value);
  }
  return description;
}

std::string RobotDraft::text(const std::string& urdf, const std::string& description) const {
  std::string out = fmt::format(
      "# Made from the URDF. What that does not say is included: gravity, drives, sensors.\n"
      "include: {}\n"
      "urdf: {}\n",
      yamlText(description), yamlText(urdf));
  for (const Key& key : keys_) {
    out += fmt::format("{}: {}{}{}\n", key.path, key.value, *key.words ? "   # " : "", key.words);
  }
  std::string group;
  if (!drives_.empty()) out += "actuators:   # their limits are the URDF's\n";
  for (const Key& key : drives_) {
    const std::size_t first = key.path.find('.'), second = key.path.rfind('.');
    const std::string own = key.path.substr(first + 1, second - first - 1);
    if (own != group) out += fmt::format("  {}:\n", own);
    group = own;
    out += fmt::format("    {}: {}\n", key.path.substr(second + 1), key.value);
  }
  return out;
}

}  // namespace ballbot
