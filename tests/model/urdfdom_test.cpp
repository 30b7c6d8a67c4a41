#include <urdf_model/joint.h>
#include <urdf_model/link.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "tests/model/edited_robot.hpp"

namespace ballbot {
namespace {

/// The field's own URDF parser as the oracle of ours, which says more of what it does not take.
class UrdfdomOracle : public EditedRobot {
 protected:
  urdf::ModelInterfaceSharedPtr parse() const {
    return urdf::parseURDFFile((folder_ / "ballbot.urdf").string());
  }
};

TEST_F(UrdfdomOracle, ArmJointsAreTheSame) {
  const auto model = parse();
  ASSERT_TRUE(model);
  const RobotParameters robot = read();
  for (const ArmLink& link : robot.arm) {
    const auto body = model->getLink(link.name);
    ASSERT_TRUE(body) << link.name;
    const urdf::Joint& joint = *body->parent_joint;
    const urdf::Vector3& axis = joint.axis;
    EXPECT_EQ(link.axis, Vector3(axis.x, axis.y, axis.z)) << link.name;
    EXPECT_EQ(link.lower_limit, joint.limits->lower) << link.name;
    EXPECT_EQ(link.upper_limit, joint.limits->upper) << link.name;
  }
}

TEST_F(UrdfdomOracle, EveryLinksMassIsCounted) {
  editUrdf("name=\"arm_2\"", "mass value=\"", "mass value=\"1");  // 1.55 kg become 11.55
  addToUrdf(
      "<link name=\"gripper\"><inertial><mass value=\"2\"/><inertia ixx=\".01\" ixy=\"0\" "
      "ixz=\"0\" iyy=\".01\" iyz=\"0\" izz=\".01\"/></inertial></link><joint name=\"hand\" "
      "type=\"fixed\"><parent link=\"end_effector\"/><child link=\"gripper\"/></joint>");
  const auto model = parse();
  ASSERT_TRUE(model);
  double total = 0;
  for (const auto& [name, link] : model->links_) {
    if (link->inertial) total += link->inertial->mass;
  }
  setTotalMass(std::to_string(total));
  EXPECT_NEAR(read().totalMass(), total, 1e-12);
}

}  // namespace
}  // namespace ballbot
