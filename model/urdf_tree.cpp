#include "model/urdf_tree.hpp"


#include <Eigen/Eigenvalues>
#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

/// urdfdom reports by log and a null pointer; this keeps what it said for the error message.
class CapturedLog : public console_bridge::OutputHandler {
 public:
  CapturedLog() { console_bridge::useOutputHandler(this); }
  ~CapturedLog() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    if (!text_.empty()) text_ += "; ";
    text_ += text;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

BodyInertia readInertial(const urdf::Inertial& in) {
  const Eigen::Isometry3d X = toTransform(in.origin);
  BodyInertia body;
  body.mass = in.mass;
  body.p_LLcm_L = X.translation();
  Matrix3 I;
  I << in.ixx, in.ixy, in.ixz, in.ixy, in.iyy, in.iyz, in.ixz, in.iyz, in.izz;
  body.I_LLcm_L = X.linear() * I * X.linear().transpose();
  return body;
}

}  // namespace

Eigen::Isometry3d toTransform(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  Eigen::Isometry3d X(Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized());
  X.translation() = Vector3(pose.position.x, pose.position.y, pose.position.z);
  return X;
}

const char* jointTypeName(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return "revolute";
    case urdf::Joint::CONTINUOUS:
      return "continuous";
    case urdf::Joint::PRISMATIC:
      return "prismatic";
    case urdf::Joint::FLOATING:
      return "floating";
    case urdf::Joint::PLANAR:
      return "planar";
    case urdf::Joint::FIXED:
      return "fixed";
    default:
      return "unknown";
  }
}

UrdfTree::UrdfTree(const std::string& path, const std::string& text) : path_(path) {
  CapturedLog log;
  try {
    model_ = urdf::parseURDF(text);
  } catch (const std::exception& e) {
    fail(fmt::format("is not a valid URDF: {}", e.what()));
  }
  if (!model_) {
    fail(fmt::format("is not a valid URDF: {}", log.text().empty() ? "no <robot>" : log.text()));
  }
}

void UrdfTree::fail(const std::string& what) const {
  throw InputError(fmt::format("{}: {}", path_, what));
}

const urdf::Link& UrdfTree::link(const std::string& name) const {
  const urdf::LinkConstSharedPtr found = model_->getLink(name);
  if (!found) {
    fail(fmt::format(
        "link '{}' is missing; the robot needs the links base, ball, wheel_1, wheel_2, wheel_3, "
        "arm_1, arm_2, arm_3, end_effector and imu",
        name));
  }
  return *found;
}

const urdf::Joint& UrdfTree::jointBetween(const std::string& parent,
                                          const std::string& child) const {
  link(parent);
  const urdf::JointSharedPtr& joint = link(child).parent_joint;
  if (!joint || joint->parent_link_name != parent) {
    fail(fmt::format(
        "link '{}' must hang on '{}', but {}", child, parent,
        joint ? fmt::format("hangs on '{}'", joint->parent_link_name) : "is the root of the tree"));
  }
  return *joint;
}

BodyInertia UrdfTree::inertia(const std::string& name, const std::set<std::string>& named) const {
  const BodyInertia body = lumped(link(name), named);
  if (!(body.mass > 0)) fail(fmt::format("link '{}' has no <inertial> with a mass", name));
  checkRigid(name, body);
  return body;
}

BodyInertia UrdfTree::lumped(const urdf::Link& link, const std::set<std::string>& named) const {
  BodyInertia sum;
  if (link.inertial) {
    sum = readInertial(*link.inertial);
    checkRigid(link.name, sum);
  }
  for (const urdf::JointSharedPtr& joint : link.child_joints) {
    if (named.count(joint->child_link_name)) continue;
    if (joint->type != urdf::Joint::FIXED) {
      fail(
          fmt::format("link '{}' hangs on joint '{}' of type {}; only ball, wheels and arm move, "
                      "so it must be fixed",
                      joint->child_link_name, joint->name, jointTypeName(*joint)));
    }
    BodyInertia part = lumped(*model_->getLink(joint->child_link_name), named);
    const Eigen::Isometry3d X = toTransform(joint->parent_to_joint_origin_transform);
    part.p_LLcm_L = X.linear() * part.p_LLcm_L;
    part.I_LLcm_L = X.linear() * part.I_LLcm_L * X.linear().transpose();
    sum = composed(sum, part, X.translation());
  }
  return sum;
}

void UrdfTree::checkRigid(const std::string& name, const BodyInertia& body) const {
  if (!(body.mass > 0))
    fail(fmt::format("link '{}': mass is {} kg, must be more than 0", name, body.mass));
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(body.I_LLcm_L, Eigen::EigenvaluesOnly);
  const Vector3 principal = solver.eigenvalues();  // ascending
  if (!(principal[0] > 0)) {
    fail(fmt::format(
        "link '{}': inertia is not positive definite; its principal moments are {:.6g}, "
        "{:.6g}, {:.6g} kg m^2",
        name, principal[0], principal[1], principal[2]));
  }
  // A thin disc reaches equality; the margin is for rounding only.
  if (principal[0] + principal[1] < principal[2] * (1 - 1e-9)) {
    fail(
        fmt::format("link '{}': no rigid body has this inertia: of its principal moments {:.6g}, "
                    "{:.6g}, {:.6g} kg m^2 the largest exceeds the sum of the others",
                    name, principal[0], principal[1], principal[2]));
  }
}

}  // namespace ballbot
