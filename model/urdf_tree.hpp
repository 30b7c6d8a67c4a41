#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "model/urdf_description.hpp"

namespace ballbot {

/// The links of a URDF as the tree that their joints make, with whatever is fixed to a link made
/// part of its body. Every error is an InputError that begins with file and line.
class UrdfTree {
 public:
  /// @throw InputError unless the joints make one tree of all links.
  explicit UrdfTree(UrdfDescription description);
  UrdfTree(const UrdfTree&) = delete;
  UrdfTree& operator=(const UrdfTree&) = delete;

  const std::string& file() const { return description_.file; }
  const std::string& name() const { return description_.name; }

  /// @throw InputError if there is no such link.
  const UrdfLink& link(const std::string& name) const { return description_.links[indexOf(name)]; }
  bool isRoot(const std::string& link) const { return parent_joint_[indexOf(link)] == nullptr; }
  /// The joint above `child`. @throw InputError unless it hangs on `parent`.
  const UrdfJoint& jointBetween(const std::string& parent, const std::string& child) const;

  /// Makes every link part of the body it is fixed to; only the links in `bodies` stand for
  /// themselves. To be called before `body`.
  /// @throw InputError if any other link hangs on a joint that moves.
  void merge(const std::set<std::string>& bodies);
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
  void checkRigid(std::size_t link) const;

  UrdfDescription description_;
  // One each link:
  std::map<std::string, std::size_t> index_;
  std::vector<const UrdfJoint*> parent_joint_;  ///< null at the root
  std::vector<std::size_t> order_;              ///< parents before children
  std::vector<BodyInertia> body_;
  std::vector<bool> composite_;  ///< whether others were merged into it
};

}  // namespace ballbot
