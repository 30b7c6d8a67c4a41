#pragma once

#include <set>
#include <string>

#include <Eigen/Geometry>
#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include "model/robot_parameters.hpp"

namespace ballbot {

/// A parsed URDF with checked access; only urdf_loader.cpp includes this. Every error is an
/// InputError that begins with the file and names the link or joint.
class UrdfTree {
 public:
  /// @param path  where `text` stands, for messages
  /// @throw InputError if urdfdom finds no robot in it.
  UrdfTree(const std::string& path, const std::string& text);

  const std::string& name() const { return model_->name_; }

  /// @throw InputError if there is no such link.
  const urdf::Link& link(const std::string& name) const;
  /// The joint above `child`. @throw InputError unless it hangs on `parent`.
  const urdf::Joint& jointBetween(const std::string& parent, const std::string& child) const;

  /// Mass properties of a link with everything fixed to it, except the links in `named`.
  /// @throw InputError if the sum has no mass or is not the inertia of a rigid body, or if a link
  ///        that is not in `named` hangs on a joint that moves.
  BodyInertia inertia(const std::string& link, const std::set<std::string>& named) const;

  /// @throw InputError "<file>: <what>".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  BodyInertia lumped(const urdf::Link& link, const std::set<std::string>& named) const;
  void checkRigid(const std::string& link, const BodyInertia& body) const;

  std::string path_;
  urdf::ModelInterfaceSharedPtr model_;
};

/// A URDF pose as a transform.
Eigen::Isometry3d toTransform(const urdf::Pose& pose);
const char* jointTypeName(const urdf::Joint& joint);

}  // namespace ballbot
