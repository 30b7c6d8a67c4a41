#include "model/urdf_loader.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "model/limits.hpp"
#include "model/urdf_tree.hpp"

namespace ballbot {
namespace {

constexpr double kSameLength_m = 1e-9;
constexpr double kSameRatio = 1e-9;

/// A revolute joint beyond three turns is rare; one limited in degrees by mistake is not.
constexpr double kManyTurns_rad = 20;

const std::set<std::string> kBodies{"base",    "ball",  "wheel_1", "wheel_2",
                                    "wheel_3", "arm_1", "arm_2",   "arm_3"};

void requireType(const UrdfTree& tree, const UrdfJoint& joint,
                 std::initializer_list<UrdfJointType> suitable, const std::string& expected) {
  if (std::find(suitable.begin(), suitable.end(), joint.type) != suitable.end()) return;
  tree.fail(joint.line, fmt::format("joint '{}' of link '{}' is {}, must be {}", joint.name,
                                    joint.child, toText(joint.type), expected));
}

/// A frame that must be parallel to its parent's.
Vector3 parallelOrigin(const UrdfTree& tree, const UrdfJoint& joint) {
  if ((joint.X_PC.linear() - Matrix3::Identity()).norm() > 1e-12) {
    tree.fail(joint.line,
              fmt::format("joint '{}' turns the frame of link '{}'; its rpy must be zero",
                          joint.name, joint.child));
  }
  return joint.X_PC.translation();
}

double readBallRadius(const UrdfTree& tree, const UrdfLink& link) {
  if (link.spheres.size() != 1) {
    tree.fail(link.line, fmt::format("link 'ball' has {} <collision> spheres, must have one, which "
                                     "gives the ball's radius",
                                     link.spheres.size()));
  }
  const UrdfSphere& sphere = link.spheres.front();
  if (sphere.p_LS.norm() > kSameLength_m) {
    tree.fail(sphere.line, "link 'ball': the sphere must have its centre at the link's origin");
  }
  if (!(sphere.radius > 0)) {
    tree.fail(sphere.line, "link 'ball': the radius of its sphere must be more than 0");
  }
  return sphere.radius;
}

RobotParameters::Ball readBall(const UrdfTree& tree) {
  const UrdfJoint& joint = tree.jointBetween("base", "ball");
  requireType(tree, joint, {UrdfJointType::kFloating, UrdfJointType::kFixed}, "floating or fixed");
  if (parallelOrigin(tree, joint).norm() > kSameLength_m) {
    tree.fail(joint.line, "link 'ball' must have its origin at that of 'base': the ball's centre");
  }
  const UrdfDrive& drive = joint.drive;
  if (drive.damping || drive.dry_friction) {
    tree.fail(joint.line, "joint '" + joint.name + "': the ball rolls without <dynamics>");
  }
  const BodyInertia& body = tree.body("ball");
  const Matrix3& I = body.I_LLcm_L;
  if (body.p_LLcm_L.norm() > kSameLength_m ||
      (I - I(0, 0) * Matrix3::Identity()).norm() > kSameRatio * I(0, 0)) {
    tree.fail(tree.link("ball").line,
              "link 'ball' must have its centre of mass at its origin and equal moments of inertia "
              "about all axes");
  }
  return {readBallRadius(tree, tree.link("ball")), body.mass, I(0, 0)};
}

void readWheel(const UrdfTree& tree, int i, UrdfRobot& robot) {
  const std::string name = fmt::format("wheel_{}", i + 1);
  const UrdfJoint& joint = tree.jointBetween("base", name);
  requireType(tree, joint, {UrdfJointType::kContinuous}, "continuous");
  const Vector3& axis = joint.axis;
  robot.wheel_centre[i] = joint.X_PC.translation();
  robot.wheel_axle[i] = joint.X_PC.linear() * axis;
  robot.drives[i] = joint.drive;

  const BodyInertia& body = tree.body(name);
  const double spin = axis.dot(body.I_LLcm_L * axis);
  const double transverse = 0.5 * (body.I_LLcm_L.trace() - spin);
  const Matrix3 disc =
      transverse * Matrix3::Identity() + (spin - transverse) * axis * axis.transpose();
  const int line = tree.link(name).line;
  if (body.p_LLcm_L.norm() > kSameLength_m || (body.I_LLcm_L - disc).norm() > kSameRatio * spin) {
    tree.fail(line, fmt::format("link '{}' must have its centre of mass at its origin and equal "
                                "moments of inertia about all axes across the axle",
                                name));
  }
  RobotParameters::Wheels& wheels = robot.parameters.wheels;
  if (i > 0 && (std::abs(body.mass - wheels.mass) > kSameRatio * wheels.mass ||
                std::abs(spin - wheels.spin_inertia) > kSameRatio * spin ||
                std::abs(transverse - wheels.transverse_inertia) > kSameRatio * spin)) {
    tree.fail(line, fmt::format("link '{}' must have the mass and inertia of 'wheel_1'", name));
  }
  wheels.mass = body.mass;
  wheels.spin_inertia = spin;
  wheels.transverse_inertia = transverse;
}

void noteStrangeLimits(const UrdfJoint& joint, std::vector<std::string>& notes) {
  for (const double limit : {joint.lower_limit, joint.upper_limit}) {
    if (std::abs(limit) <= kManyTurns_rad || std::abs(limit) >= kUnlimited) continue;
    notes.push_back(
        fmt::format("{} has a limit at {} rad, {:.3g} turns away. URDF counts in rad: "
                    "{} degrees would be {:.4g}",
                    joint.drive.where, limit, limit / kTwoPi, limit, limit * kRadPerDeg));
    return;
  }
}

void readArmLink(const UrdfTree& tree, int i, UrdfRobot& robot) {
  ArmLink& link = robot.parameters.arm[i];
  link.name = fmt::format("arm_{}", i + 1);
  const UrdfJoint& joint = tree.jointBetween(i == 0 ? "base" : fmt::format("arm_{}", i), link.name);
  requireType(tree, joint, {UrdfJointType::kRevolute, UrdfJointType::kContinuous},
              "revolute or continuous");
  link.p_PJ_P = parallelOrigin(tree, joint);
  link.axis = joint.axis;
  link.inertia = tree.body(link.name);
  link.lower_limit = joint.lower_limit;
  link.upper_limit = joint.upper_limit;
  if (!(link.lower_limit < link.upper_limit)) {
    tree.fail(joint.line, fmt::format("joint '{}' of link '{}': lower limit {} must be below upper "
                                      "limit {}",
                                      joint.name, link.name, link.lower_limit, link.upper_limit));
  }
  robot.drives[kWheelCount + i] = joint.drive;
  noteStrangeLimits(joint, robot.notes);
}

/// Pose of `child`, which is fixed to `parent`.
const Eigen::Isometry3d& readFixedFrame(const UrdfTree& tree, const std::string& parent,
                                        const std::string& child) {
  const UrdfJoint& joint = tree.jointBetween(parent, child);
  requireType(tree, joint, {UrdfJointType::kFixed}, "fixed");
  return joint.X_PC;
}

UrdfRobot parse(const std::string& path, const std::string& text) {
  UrdfTree tree(readUrdf(path, text));
  if (!tree.isRoot("base")) {
    tree.fail(tree.link("base").line, "link 'base' must be the root of the tree");
  }
  tree.merge(kBodies);

  UrdfRobot robot;
  RobotParameters& p = robot.parameters;
  p.name = tree.name();
  p.ball = readBall(tree);
  p.base = tree.body("base");
  for (int i = 0; i < kWheelCount; ++i) readWheel(tree, i, robot);
  for (int i = 0; i < kArmJointCount; ++i) readArmLink(tree, i, robot);

  const Eigen::Isometry3d& X_A3E = readFixedFrame(tree, "arm_3", "end_effector");
  p.p_A3E = X_A3E.translation();
  p.R_A3E = X_A3E.linear();
  readFixedFrame(tree, "base", "imu");
  p.p_BI_B = parallelOrigin(tree, tree.jointBetween("base", "imu"));
  return robot;
}

}  // namespace

UrdfRobot loadUrdf(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  if (!file) throw InputError(fmt::format("{}: cannot be read", path));
  // The parts of one run and the cases of a study all ask for the same robot: parsed once.
  static std::mutex guard;
  static std::map<std::pair<std::string, std::string>, UrdfRobot> known;
  const std::lock_guard<std::mutex> lock(guard);
  const std::pair<std::string, std::string> key(path, text.str());
  auto found = known.find(key);
  if (found == known.end()) found = known.emplace(key, parse(path, key.second)).first;
  return found->second;
}

}  // namespace ballbot
