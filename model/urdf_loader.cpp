#include "model/urdf_loader.hpp"

#include <cmath>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "model/urdf_tree.hpp"

namespace ballbot {
namespace {

constexpr double kSameLength_m = 1e-9;
constexpr double kSameRatio = 1e-9;

const std::set<std::string> kNamedLinks{"base",  "ball",  "wheel_1", "wheel_2",      "wheel_3",
                                        "arm_1", "arm_2", "arm_3",   "end_effector", "imu"};

Vector3 toVector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

void requireType(const UrdfTree& tree, const urdf::Joint& joint, bool suitable,
                 const std::string& expected) {
  if (suitable) return;
  tree.fail(fmt::format("joint '{}' of link '{}' is {}, must be {}", joint.name,
                        joint.child_link_name, jointTypeName(joint), expected));
}

/// A frame that must be parallel to its parent's.
Vector3 parallelOrigin(const UrdfTree& tree, const urdf::Joint& joint) {
  const Eigen::Isometry3d X = toTransform(joint.parent_to_joint_origin_transform);
  if ((X.linear() - Matrix3::Identity()).norm() > 1e-12) {
    tree.fail(fmt::format("joint '{}' turns the frame of link '{}'; its rpy must be zero",
                          joint.name, joint.child_link_name));
  }
  return X.translation();
}

RobotParameters::Ball readBall(const UrdfTree& tree) {
  const urdf::Joint& joint = tree.jointBetween("base", "ball");
  requireType(tree, joint, joint.type == urdf::Joint::FLOATING || joint.type == urdf::Joint::FIXED,
              "floating or fixed");
  if (parallelOrigin(tree, joint).norm() > kSameLength_m) {
    tree.fail("link 'ball' must have its origin at that of 'base': the ball's centre");
  }
  const urdf::CollisionSharedPtr& collision = tree.link("ball").collision;
  if (!collision || !collision->geometry || collision->geometry->type != urdf::Geometry::SPHERE) {
    tree.fail("link 'ball' needs a <collision> sphere, which gives the ball's radius");
  }
  const BodyInertia body = tree.inertia("ball", kNamedLinks);
  const Matrix3& I = body.I_LLcm_L;
  if (body.p_LLcm_L.norm() > kSameLength_m ||
      (I - I(0, 0) * Matrix3::Identity()).norm() > kSameRatio * I(0, 0)) {
    tree.fail(
        "link 'ball' must have its centre of mass at its origin and equal moments of inertia "
        "about all axes");
  }
  RobotParameters::Ball ball;
  ball.radius = static_cast<const urdf::Sphere&>(*collision->geometry).radius;
  ball.mass = body.mass;
  ball.inertia = I(0, 0);
  if (!(ball.radius > 0)) tree.fail("link 'ball': the radius of its sphere must be more than 0");
  return ball;
}

void readWheel(const UrdfTree& tree, int i, UrdfRobot& robot) {
  const std::string name = fmt::format("wheel_{}", i + 1);
  const urdf::Joint& joint = tree.jointBetween("base", name);
  requireType(tree, joint, joint.type == urdf::Joint::CONTINUOUS, "continuous");
  const Eigen::Isometry3d X = toTransform(joint.parent_to_joint_origin_transform);
  const Vector3 axis = toVector(joint.axis).normalized();
  robot.wheel_centre[i] = X.translation();
  robot.wheel_axle[i] = X.linear() * axis;

  const BodyInertia body = tree.inertia(name, kNamedLinks);
  const double spin = axis.dot(body.I_LLcm_L * axis);
  const double transverse = 0.5 * (body.I_LLcm_L.trace() - spin);
  const Matrix3 disc =
      transverse * Matrix3::Identity() + (spin - transverse) * axis * axis.transpose();
  if (body.p_LLcm_L.norm() > kSameLength_m || (body.I_LLcm_L - disc).norm() > kSameRatio * spin) {
    tree.fail(
        fmt::format("link '{}' must have its centre of mass at its origin and equal moments "
                    "of inertia about all axes across the axle",
                    name));
  }
  RobotParameters::Wheels& wheels = robot.parameters.wheels;
  if (i > 0 && (std::abs(body.mass - wheels.mass) > kSameRatio * wheels.mass ||
                std::abs(spin - wheels.spin_inertia) > kSameRatio * spin ||
                std::abs(transverse - wheels.transverse_inertia) > kSameRatio * spin)) {
    tree.fail(fmt::format("link '{}' must have the mass and inertia of 'wheel_1'", name));
  }
  wheels.mass = body.mass;
  wheels.spin_inertia = spin;
  wheels.transverse_inertia = transverse;
}

ArmLink readArmLink(const UrdfTree& tree, int i) {
  ArmLink link;
  link.name = fmt::format("arm_{}", i + 1);
  const urdf::Joint& joint =
      tree.jointBetween(i == 0 ? "base" : fmt::format("arm_{}", i), link.name);
  requireType(tree, joint, joint.type == urdf::Joint::REVOLUTE, "revolute");
  link.p_PJ_P = parallelOrigin(tree, joint);
  link.axis = toVector(joint.axis).normalized();
  link.inertia = tree.inertia(link.name, kNamedLinks);
  link.lower_limit = joint.limits->lower;  // urdfdom demands <limit> of a revolute joint
  link.upper_limit = joint.limits->upper;
  if (!(link.lower_limit < link.upper_limit)) {
    tree.fail(fmt::format("joint '{}' of link '{}': lower limit {} must be below upper limit {}",
                          joint.name, link.name, link.lower_limit, link.upper_limit));
  }
  return link;
}

/// Pose of `child`, fixed to `parent`. Massive or not, it is part of that body.
Eigen::Isometry3d readFixedFrame(const UrdfTree& tree, const std::string& parent,
                                 const std::string& child) {
  const urdf::Joint& joint = tree.jointBetween(parent, child);
  requireType(tree, joint, joint.type == urdf::Joint::FIXED, "fixed");
  if (tree.link(child).inertial) {
    tree.fail(fmt::format("link '{}' is a frame only; give its mass to '{}'", child, parent));
  }
  return toTransform(joint.parent_to_joint_origin_transform);
}

UrdfRobot parse(const std::string& path, const std::string& text) {
  const UrdfTree tree(path, text);
  if (tree.link("base").parent_joint) tree.fail("link 'base' must be the root of the tree");

  UrdfRobot robot;
  RobotParameters& p = robot.parameters;
  p.name = tree.name();
  p.ball = readBall(tree);
  p.base = tree.inertia("base", kNamedLinks);
  for (int i = 0; i < kWheelCount; ++i) readWheel(tree, i, robot);
  for (int i = 0; i < kArmJointCount; ++i) p.arm[i] = readArmLink(tree, i);

  const Eigen::Isometry3d X_A3E = readFixedFrame(tree, "arm_3", "end_effector");
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
