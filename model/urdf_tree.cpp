#include "model/urdf_tree.hpp"

#include <utility>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

/// Principal moments of inertia, ascending [kg m^2].
Vector3 principalMoments(const BodyInertia& body) {
  return Eigen::SelfAdjointEigenSolver<Matrix3>(body.I_LLcm_L, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

std::string momentsText(const Vector3& moments) {
  return fmt::format("{:.6g}, {:.6g}, {:.6g} kg m^2", moments[0], moments[1], moments[2]);
}

}  // namespace

UrdfTree::UrdfTree(UrdfDescription description, const std::vector<std::string>& bodies,
                   const std::vector<std::string>& needed)
    : description_(std::move(description)), bodies_(bodies.begin(), bodies.end()), needed_(needed) {
  nameLinks();
  hangLinks();
  orderLinks();
  for (const std::string& link : needed_) indexOf(link);
  merge();
}

void UrdfTree::nameLinks() {
  for (std::size_t i = 0; i < description_.links.size(); ++i) {
    const UrdfLink& link = description_.links[i];
    if (!index_.emplace(link.name, i).second) {
      fail(link.line, fmt::format("a second link has the name '{}'; the first is in line {}",
                                  link.name, description_.links[index_[link.name]].line));
    }
  }
}

void UrdfTree::hangLinks() {
  parent_joint_.assign(description_.links.size(), nullptr);
  std::map<std::string, int> line_of_joint;
  for (const UrdfJoint& joint : description_.joints) {
    const auto [first, is_new] = line_of_joint.emplace(joint.name, joint.line);
    if (!is_new) {
      fail(joint.line, fmt::format("a second joint has the name '{}'; the first is in line {}",
                                   joint.name, first->second));
    }
    for (const std::string& end : {joint.parent, joint.child}) {
      if (index_.count(end)) continue;
      fail(joint.line, fmt::format("joint '{}' names the link '{}', which is not in the file",
                                   joint.name, end));
    }
    const UrdfJoint*& above = parent_joint_[indexOf(joint.child)];
    if (above) {
      fail(joint.line, fmt::format("link '{}' hangs on joint '{}' already (line {}), so '{}' "
                                   "would close a loop; the robot must be a tree",
                                   joint.child, above->name, above->line, joint.name));
    }
    above = &joint;
  }
}

void UrdfTree::orderLinks() {
  std::vector<std::vector<std::size_t>> children(description_.links.size());
  for (std::size_t i = 0; i < description_.links.size(); ++i) {
    if (parent_joint_[i]) {
      children[indexOf(parent_joint_[i]->parent)].push_back(i);
    } else if (order_.empty()) {
      order_.push_back(i);
    } else {
      fail(description_.links[i].line,
           fmt::format("links '{}' and '{}' both hang on no joint; one must be the root of all",
                       description_.links[order_.front()].name, description_.links[i].name));
    }
  }
  for (std::size_t next = 0; next < order_.size(); ++next) {
    const auto& below = children[order_[next]];
    order_.insert(order_.end(), below.begin(), below.end());
  }
  if (order_.size() == description_.links.size()) return;
  std::vector<bool> reached(description_.links.size(), false);
  for (const std::size_t i : order_) reached[i] = true;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (reached[i]) continue;
    fail(description_.links[i].line,
         fmt::format("link '{}' is in a loop of joints; the robot must be a tree",
                     description_.links[i].name));
  }
}

std::size_t UrdfTree::indexOf(const std::string& link) const {
  const auto found = index_.find(link);
  if (found == index_.end()) {
    throw InputError(
        fmt::format("{}: link '{}' is missing; the robot needs the links {}, or other names for "
                    "them in robot.links",
                    file(), link, fmt::join(needed_, ", ")));
  }
  return found->second;
}

UrdfMount UrdfTree::mount(const std::string& parent, const std::string& child) const {
  const UrdfJoint* joint = parent_joint_[indexOf(child)];
  if (!joint) {
    fail(link(child).line,
         fmt::format("link '{}' must hang on '{}', but is the root of the tree", child, parent));
  }
  Eigen::Isometry3d X_BL = joint->X_PC;
  const std::string* carrier = &joint->parent;
  while (bodies_.count(*carrier) == 0) {
    const UrdfJoint* above = parent_joint_[indexOf(*carrier)];
    if (!above) break;
    X_BL = above->X_PC * X_BL;
    carrier = &above->parent;
  }
  if (*carrier != parent) {
    fail(joint->line,
         fmt::format("link '{}' must hang on '{}', but hangs on '{}'", child, parent, *carrier));
  }
  return {joint, X_BL};
}

void UrdfTree::merge() {
  const std::size_t count = description_.links.size();
  body_.resize(count);
  composite_.assign(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    body_[i] = description_.links[i].inertial.value_or(BodyInertia{});
  }
  // Children before parents, so that each is complete when it is added.
  for (auto at = order_.rbegin(); at != order_.rend(); ++at) {
    const UrdfJoint* joint = parent_joint_[*at];
    const std::string& name = description_.links[*at].name;
    if (!joint || bodies_.count(name)) continue;
    if (joint->type != UrdfJointType::kFixed) {
      fail(joint->line, fmt::format("link '{}' hangs on joint '{}' of type {}; only ball, wheels "
                                    "and the {} joints of the arm that this program is built for "
                                    "move, so it must be fixed",
                                    name, joint->name, toText(joint->type), kArmJointCount));
    }
    BodyInertia part = body_[*at];
    if (part.mass == 0) continue;  // a frame
    part.p_LLcm_L = joint->X_PC.linear() * part.p_LLcm_L;
    part.I_LLcm_L = joint->X_PC.linear() * part.I_LLcm_L * joint->X_PC.linear().transpose();
    const std::size_t parent = indexOf(joint->parent);
    body_[parent] = composed(body_[parent], part, joint->X_PC.translation());
    composite_[parent] = true;
  }
}

const BodyInertia& UrdfTree::body(const std::string& name) const {
  const std::size_t i = indexOf(name);
  checkRigid(i);
  return body_[i];
}

// After merging: a link that is a frame only, a point mass or a thin rod is no body by itself, but
// may well be part of one.
void UrdfTree::checkRigid(std::size_t i) const {
  const UrdfLink& link = description_.links[i];
  const BodyInertia& body = body_[i];
  const std::string whole =
      fmt::format("link '{}'{}", link.name, composite_[i] ? " with all that is fixed to it" : "");
  if (!(body.mass > 0)) fail(link.line, whole + " has no mass, must have some");
  const Vector3 principal = principalMoments(body);
  if (!(principal[0] > 0)) {
    fail(link.line,
         fmt::format("{}: inertia is not positive definite; its principal moments are {}", whole,
                     momentsText(principal)));
  }
  // A thin disc reaches equality; the margin is for rounding only.
  if (principal[0] + principal[1] < principal[2] * (1 - 1e-9)) {
    fail(link.line, fmt::format("{}: no rigid body has this inertia: of its principal moments {} "
                                "the largest exceeds the sum of the others",
                                whole, momentsText(principal)));
  }
}

void UrdfTree::fail(int line, const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", description_.file, line, what));
}

}  // namespace ballbot
