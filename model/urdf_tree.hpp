#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "model/urdf_description.hpp"

namespace ballbot {

/// A link that moves, or a frame, on the body that carries it.
struct UrdfMount {
  const UrdfJoint* joint;  ///< above the link; what is between that and the body is fixed
  Eigen::Isometry3d X_BL;  ///< link's frame, at zero, in the body's
};

/// The links of a URDF as the tree that their joints make, with whatever is fixed to a link made
/// part of its body. Every error is an InputError that begins with file and line.
class UrdfTree {
 public:
  /// @param bodies  links that stand for themselves; every other one is part of that which it is
  ///                fixed to
  /// @param needed  those that are asked for, for messages
  /// @throw InputError unless the joints make one tree of all links, in which only bodies move.
  UrdfTree(UrdfDescription description, const std::vector<std::string>& bodies,
           const std::vector<std::string>& needed);
  UrdfTree(const UrdfTree&) = delete;
  UrdfTree& operator=(const UrdfTree&) = delete;

  const std::string& file() const { return description_.file; }
  const std::string& name() const { return description_.name; }

  /// @throw InputError if there is no such link.
  const UrdfLink& link(const std::string& name) const { return description_.links[indexOf(name)]; }
  bool isRoot(const std::string& link) const { return parent_joint_[indexOf(link)] == nullptr; }
  /// How `child` hangs on the body `parent`, be it by way of links that are fixed to that.
  /// @throw InputError if it hangs on another one.
  UrdfMount mount(const std::string& parent, const std::string& child) const;

  /// Mass properties of a link with all that is merged into it.
  /// @throw InputError if that has no mass or is not the inertia of a rigid body.
  const BodyInertia& body(const std::string& link) const;

  /// @throw InputError "<file>:<line>: <what>".
  [[noreturn]] void fail(int line, const std::string& what) const;

 private:
  std::size_t indexOf(const std::string& link) const;
  void nameLinks();
  void hangLinks();
  void orderLinks();
  void merge();
  void checkRigid(std::size_t link) const;

  UrdfDescription description_;
  std::set<std::string> bodies_;
  std::vector<std::string> needed_;
  // One each link:
  std::map<std::string, std::size_t> index_;
  std::vector<const UrdfJoint*> parent_joint_;  ///< null at the root
  std::vector<std::size_t> order_;              ///< parents before children
  std::vector<BodyInertia> body_;
  std::vector<bool> composite_;  ///< whether others were merged into it
};

}  // namespace ballbot
