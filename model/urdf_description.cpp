#include "model/urdf_description.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "model/limits.hpp"
#include "model/urdf_xml.hpp"

namespace ballbot {
namespace {

constexpr std::pair<const char*, UrdfJointType> kJointTypes[] = {
    {"revolute", UrdfJointType::kRevolute},   {"continuous", UrdfJointType::kContinuous},
    {"prismatic", UrdfJointType::kPrismatic}, {"fixed", UrdfJointType::kFixed},
    {"floating", UrdfJointType::kFloating},   {"planar", UrdfJointType::kPlanar}};

/// URDF's fixed-axis roll, pitch, yaw as R_z R_y R_x, by way of the unit quaternion.
Matrix3 rotationOf(const Vector3& rpy) {
  const Vector3 s = (0.5 * rpy).array().sin(), c = (0.5 * rpy).array().cos();
  return Eigen::Quaterniond(
             c[0] * c[1] * c[2] + s[0] * s[1] * s[2], s[0] * c[1] * c[2] - c[0] * s[1] * s[2],
             c[0] * s[1] * c[2] + s[0] * c[1] * s[2], c[0] * c[1] * s[2] - s[0] * s[1] * c[2])
      .normalized()
      .toRotationMatrix();
}

/// The <origin> of an element, where it has one.
Eigen::Isometry3d readOrigin(const UrdfElement& of) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const auto origin = of.child("origin");
  if (!origin) return X;
  origin->onlyAttributes({"xyz", "rpy"});
  X.translation() = origin->vectorOr("xyz", Vector3::Zero());
  X.linear() = rotationOf(origin->vectorOr("rpy", Vector3::Zero()));
  return X;
}

BodyInertia readInertial(const UrdfElement& in) {
  in.noMisspeltChildren({"origin", "mass", "inertia"});
  const Eigen::Isometry3d X = readOrigin(in);
  const UrdfElement mass = in.requiredChild("mass"), inertia = in.requiredChild("inertia");
  mass.onlyAttributes({"value"});
  inertia.onlyAttributes({"ixx", "ixy", "ixz", "iyy", "iyz", "izz"});

  BodyInertia body;
  body.mass = mass.number("value");
  body.p_LLcm_L = X.translation();
  // Products that are left out are zero, moments are not.
  const auto product = [&](const char* name) { return inertia.numberIfAny(name).value_or(0); };
  const double xy = product("ixy"), xz = product("ixz"), yz = product("iyz");
  const auto moment = [&](const char* name) {
    const double value = inertia.number(name);
    if (value < 0) inertia.fail(fmt::format("{} is {} kg m^2, must not be negative", name, value));
    return value;
  };
  Matrix3 I;
  I << moment("ixx"), xy, xz, xy, moment("iyy"), yz, xz, yz, moment("izz");
  body.I_LLcm_L = X.linear() * I * X.linear().transpose();
  if (body.mass < 0) mass.fail(fmt::format("value is {} kg, must not be negative", body.mass));
  if (body.mass == 0 && !I.isZero(0)) {
    inertia.fail("is not zero, but the mass is; a body without mass has no inertia");
  }
  return body;
}

void readCollision(const UrdfElement& collision, UrdfLink& link) {
  const auto geometry = collision.child("geometry");
  const auto sphere = geometry ? geometry->child("sphere") : std::nullopt;
  if (!sphere) return;
  sphere->onlyAttributes({"radius"});
  link.spheres.push_back(
      {sphere->line(), readOrigin(collision).translation(), sphere->number("radius")});
}

UrdfLink readLink(const UrdfElement& in) {
  UrdfLink link;
  link.line = in.line();
  link.name = in.text("name");
  in.noMisspeltChildren({"inertial", "visual", "collision"});
  if (const auto inertial = in.child("inertial")) link.inertial = readInertial(*inertial);
  for (const UrdfElement& e : in.children()) {
    if (e.tag() == "collision") readCollision(e, link);
    if (e.tag() == "mass") e.fail("would be ignored; put it in <inertial>");
  }
  return link;
}

UrdfJointType readType(const UrdfElement& in) {
  const std::string text = in.text("type");
  for (const auto& [name, type] : kJointTypes) {
    if (text == name) return type;
  }
  in.fail(fmt::format(
      "type is '{}', must be one of: revolute, continuous, prismatic, fixed, floating, planar",
      text));
}

std::string readEnd(const UrdfElement& joint, const char* tag) {
  const UrdfElement end = joint.requiredChild(tag);
  end.onlyAttributes({"link"});
  return end.text("link");
}

void readAxis(const UrdfElement& in, UrdfJoint& joint) {
  const auto axis = in.child("axis");
  if (!axis) return;
  axis->onlyAttributes({"xyz"});
  joint.axis = axis->vectorOr("xyz", joint.axis);
  if (!(joint.axis.norm() > 1e-6)) axis->fail("xyz is zero, must be a direction");
  joint.axis.normalize();
}

void readLimit(const UrdfElement& in, UrdfJoint& joint) {
  const auto limit = in.child("limit");
  if (joint.type == UrdfJointType::kContinuous) {
    joint.lower_limit = -kUnlimited;
    joint.upper_limit = kUnlimited;
  } else if (joint.type == UrdfJointType::kRevolute && !limit) {
    in.fail("has no <limit>; a revolute joint without limits is continuous");
  } else if (joint.type == UrdfJointType::kPrismatic && !limit) {
    in.fail("has no <limit>, which a prismatic joint must have");
  }
  if (!limit) return;
  limit->onlyAttributes({"lower", "upper", "effort", "velocity"});
  if (joint.type != UrdfJointType::kContinuous) {
    const auto within = [&](const char* name) {
      return std::clamp(limit->limitIfAny(name).value_or(0), -kUnlimited, kUnlimited);
    };
    joint.lower_limit = within("lower");
    joint.upper_limit = within("upper");
  }
  const auto said = [&](const char* name) {
    const auto value = limit->limitIfAny(name);
    return value && *value != 0 && std::abs(*value) < kUnlimited ? value : std::nullopt;
  };
  joint.drive.effort = said("effort");
  joint.drive.velocity = said("velocity");
}

void readFriction(const UrdfElement& in, UrdfJoint& joint) {
  const auto dynamics = in.child("dynamics");
  if (!dynamics) return;
  dynamics->onlyAttributes({"damping", "friction"});
  const auto said = [&](const char* name) {
    const auto value = dynamics->numberIfAny(name);
    return value && *value != 0 ? value : std::nullopt;
  };
  joint.drive.damping = said("damping");
  joint.drive.dry_friction = said("friction");
}

/// What a joint that moves would do in other simulators, and would not do here.
void refuseWhatIsNotSimulated(const UrdfElement& in) {
  if (const auto mimic = in.child("mimic")) {
    mimic->fail("joints that follow others are not simulated; fix the joint, or drive it");
  }
  if (const auto soft = in.child("safety_controller")) {
    soft->fail("soft limits are not simulated; take the element out, and <limit> holds");
  }
}

UrdfJoint readJoint(const UrdfElement& in, const std::string& file) {
  UrdfJoint joint;
  joint.line = in.line();
  joint.name = in.text("name");
  joint.drive.where = fmt::format("{}:{}: joint '{}'", file, joint.line, joint.name);
  in.noMisspeltChildren({"origin", "parent", "child", "axis", "calibration", "dynamics", "limit",
                         "mimic", "safety_controller"});
  joint.type = readType(in);
  joint.parent = readEnd(in, "parent");
  joint.child = readEnd(in, "child");
  joint.X_PC = readOrigin(in);
  if (joint.type == UrdfJointType::kFixed) return joint;  // the rest is about motion
  refuseWhatIsNotSimulated(in);
  readLimit(in, joint);
  readFriction(in, joint);
  if (joint.type != UrdfJointType::kFloating) readAxis(in, joint);
  return joint;
}

}  // namespace

const char* toText(UrdfJointType type) {
  for (const auto& [name, known] : kJointTypes) {
    if (known == type) return name;
  }
  return "unknown";
}

UrdfDescription readUrdf(const std::string& file, const std::string& text) {
  const UrdfXml xml(file, text);
  const UrdfElement robot = xml.robot();
  UrdfDescription out;
  out.file = file;
  out.name = robot.text("name");
  robot.noMisspeltChildren({"link", "joint", "material", "transmission", "gazebo", "sensor"});
  for (const UrdfElement& e : robot.children()) {
    if (e.tag() == "link") out.links.push_back(readLink(e));
    if (e.tag() == "joint") out.joints.push_back(readJoint(e, file));
  }
  return out;
}

}  // namespace ballbot
