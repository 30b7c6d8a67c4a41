#include "model/urdf_loader.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <map>
#include <mutex>
#include <sstream>

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

void requireType(const UrdfTree& tree, const UrdfJoint& joint,
                 std::initializer_list<UrdfJointType> suitable, const std::string& expected) {
  if (std::find(suitable.begin(), suitable.end(), joint.type) != suitable.end()) return;
  tree.fail(joint.line, fmt::format("joint '{}' of link '{}' is {}, must be {}", joint.name,
                                    joint.child, toText(joint.type), expected));
}

/// `body` as it is in a frame with the same origin whose axes R takes it to. What is not turned
/// keeps its bits.
BodyInertia turned(const Matrix3& R, const BodyInertia& body) {
  if (R.isIdentity(0)) return body;
  return {body.mass, R * body.p_LLcm_L, R * body.I_LLcm_L * R.transpose()};
}
Vector3 turned(const Matrix3& R, const Vector3& v) { return R.isIdentity(0) ? v : Vector3(R * v); }

double readBallRadius(const UrdfTree& tree, const UrdfLink& link) {
  if (link.spheres.size() != 1) {
    tree.fail(link.line, fmt::format("link '{}' has {} <collision> spheres, must have one, which "
                                     "gives the ball's radius",
                                     link.name, link.spheres.size()));
  }
  const UrdfSphere& sphere = link.spheres.front();
  if (sphere.p_LS.norm() > kSameLength_m) {
    tree.fail(sphere.line, fmt::format("link '{}': the sphere must have its centre at the link's "
                                       "origin",
                                       link.name));
  }
  if (!(sphere.radius > 0)) {
    tree.fail(sphere.line,
              fmt::format("link '{}': the radius of its sphere must be more than 0", link.name));
  }
  return sphere.radius;
}

RobotParameters::Ball readBall(const UrdfTree& tree, const RobotLinks& links) {
  const UrdfMount mount = tree.mount(links.base, links.ball);
  const UrdfJoint& joint = *mount.joint;
  requireType(tree, joint, {UrdfJointType::kFloating, UrdfJointType::kFixed}, "floating or fixed");
  if (mount.X_BL.translation().norm() > kSameLength_m) {
    tree.fail(joint.line, fmt::format("link '{}' must have its origin at that of '{}': the ball's "
                                      "centre",
                                      links.ball, links.base));
  }
  const UrdfDrive& drive = joint.drive;
  if (drive.damping || drive.dry_friction) {
    tree.fail(joint.line, "joint '" + joint.name + "': the ball rolls without <dynamics>");
  }
  const BodyInertia& body = tree.body(links.ball);
  const Matrix3& I = body.I_LLcm_L;
  if (body.p_LLcm_L.norm() > kSameLength_m ||
      (I - I(0, 0) * Matrix3::Identity()).norm() > kSameRatio * I(0, 0)) {
    tree.fail(tree.link(links.ball).line,
              fmt::format("link '{}' must have its centre of mass at its origin and equal moments "
                          "of inertia about all axes",
                          links.ball));
  }
  return {readBallRadius(tree, tree.link(links.ball)), body.mass, I(0, 0)};
}

void readWheel(const UrdfTree& tree, const RobotLinks& links, int i, UrdfRobot& robot) {
  const std::string& name = links.wheels[static_cast<std::size_t>(i)];
  const UrdfMount mount = tree.mount(links.base, name);
  const UrdfJoint& joint = *mount.joint;
  requireType(tree, joint, {UrdfJointType::kContinuous}, "continuous");
  const Vector3& axis = joint.axis;
  robot.wheel_centre[i] = mount.X_BL.translation();
  robot.wheel_axle[i] = mount.X_BL.linear() * axis;
  robot.drives[i] = joint.drive;
  robot.joints[i] = joint.name;

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
    tree.fail(line, fmt::format("link '{}' must have the mass and inertia of '{}'", name,
                                links.wheels[0]));
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

double angleOf(double way, double lead) {
  return std::abs(way) < kUnlimited ? std::clamp(way / lead, -kUnlimited, kUnlimited) : way;
}

/// What a file says of a drive that slides, as its pinion has it.
UrdfDrive turning(UrdfDrive drive, double lead) {
  drive.where += fmt::format(", at {:g} m per rad of its drive,", lead);
  if (drive.effort) *drive.effort *= lead;
  if (drive.velocity) *drive.velocity /= lead;
  if (drive.damping) *drive.damping *= lead * lead;
  if (drive.dry_friction) *drive.dry_friction *= lead;
  return drive;
}

/// @param R_BP  axes of the body that carries the link, at zero angles; becomes the link's own
void readArmLink(const UrdfTree& tree, const RobotLinks& links, int i, Matrix3& R_BP,
                 UrdfRobot& robot) {
  ArmLink& link = robot.parameters.arm[i];
  const auto at = static_cast<std::size_t>(i);
  link.name = links.arm[at];
  const UrdfMount mount = tree.mount(i == 0 ? links.base : links.arm[at - 1], link.name);
  const UrdfJoint& joint = *mount.joint;
  requireType(tree, joint,
              {UrdfJointType::kRevolute, UrdfJointType::kContinuous, UrdfJointType::kPrismatic},
              "revolute, continuous or prismatic");
  const bool slides = joint.type == UrdfJointType::kPrismatic;
  link.lead = slides ? robot.slide_lead : 0;
  link.p_PJ_P = turned(R_BP, mount.X_BL.translation());
  if (!mount.X_BL.linear().isIdentity(0)) R_BP *= mount.X_BL.linear();
  link.axis = turned(R_BP, joint.axis);
  link.inertia = turned(R_BP, tree.body(link.name));
  link.lower_limit = slides ? angleOf(joint.lower_limit, link.lead) : joint.lower_limit;
  link.upper_limit = slides ? angleOf(joint.upper_limit, link.lead) : joint.upper_limit;
  if (!(link.lower_limit < link.upper_limit)) {
    tree.fail(joint.line, fmt::format("joint '{}' of link '{}': lower limit {} must be below upper "
                                      "limit {}",
                                      joint.name, link.name, link.lower_limit, link.upper_limit));
  }
  robot.drives[kWheelCount + i] = slides ? turning(joint.drive, link.lead) : joint.drive;
  robot.joints[kWheelCount + i] = joint.name;
  if (!slides) noteStrangeLimits(joint, robot.notes);
}

/// Pose of `child`, which is fixed to `parent`.
Eigen::Isometry3d readFixedFrame(const UrdfTree& tree, const std::string& parent,
                                 const std::string& child) {
  const UrdfMount mount = tree.mount(parent, child);
  requireType(tree, *mount.joint, {UrdfJointType::kFixed}, "fixed");
  return mount.X_BL;
}

UrdfRobot parse(const std::string& path, const std::string& text, const RobotLinks& links,
                double lead) {
  const UrdfTree tree(readUrdf(path, text), links.bodies(), links.all());
  if (!tree.isRoot(links.base)) {
    tree.fail(tree.link(links.base).line,
              fmt::format("link '{}' must be the root of the tree", links.base));
  }

  UrdfRobot robot;
  robot.slide_lead = lead;
  RobotParameters& p = robot.parameters;
  p.name = tree.name();
  p.ball = readBall(tree, links);
  p.base = tree.body(links.base);
  for (int i = 0; i < kWheelCount; ++i) readWheel(tree, links, i, robot);
  Matrix3 R_BL = Matrix3::Identity();
  for (int i = 0; i < kArmJointCount; ++i) readArmLink(tree, links, i, R_BL, robot);

  const Eigen::Isometry3d X_A3E = readFixedFrame(tree, links.arm.back(), links.end_effector);
  p.p_A3E = turned(R_BL, X_A3E.translation());
  p.R_A3E = R_BL.isIdentity(0) ? Matrix3(X_A3E.linear()) : Matrix3(R_BL * X_A3E.linear());
  p.p_BI_B = readFixedFrame(tree, links.base, links.imu).translation();
  return robot;
}

}  // namespace

UrdfRobot loadUrdf(const std::string& path, const RobotLinks& links, double lead) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  if (!file) throw InputError(fmt::format("{}: cannot be read", path));
  // The parts of one run and the cases of a study all ask for the same robot: parsed once.
  static std::mutex guard;
  static std::map<std::vector<std::string>, UrdfRobot> known;
  const std::lock_guard<std::mutex> lock(guard);
  std::vector<std::string> key = links.all();
  key.insert(key.end(), {fmt::format("{}", lead), path, text.str()});
  auto found = known.find(key);
  if (found == known.end()) found = known.emplace(key, parse(path, key.back(), links, lead)).first;
  return found->second;
}

}  // namespace ballbot
