#include "controller/reference_limits.hpp"

#include <gmock/gmock.h>

#include "controller/lqr_law.hpp"
#include "controller/mpc_planner.hpp"
#include "controller/pd_tracker.hpp"
#include "core/error.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;

class ReferenceLimits : public testing::Test {
 protected:
  /// What is said about the shipped MPC with one task more; nothing where that is good.
  std::string saidOf(const std::string& change) {
    applyOverride(tree_, "mpc.contact_forces=true");
    applyOverride(tree_, "mpc.tasks." + change);
    ConfigReader in(tree_);
    ConfigReader mpc = in.child("mpc");
    try {
      MpcConfig::read(mpc, robot_);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  RobotParameters robot_ = exampleRobot();
  ConfigNode tree_ = loadYamlFile(BALLBOT_SOURCE_DIR "/configs/controllers/mpc.yaml");
};

TEST_F(ReferenceLimits, AnArmPoseBeyondAStopIsRefused) {
  EXPECT_EQ(saidOf("arm_position={weight: 5, reference: {moves: [{at_s: 2, by: [0, 0, 0.3]}]}}"),
            "");
  EXPECT_THAT(
      saidOf("arm_position={weight: 5, reference: {moves: [{at_s: 2, by: [0, 0, 2]}]}}"),
      HasSubstr("arm_position asks at 2 s for 4.171 rad of joint 3 ('arm_3'), must be between "
                "0 and 2.6"));
}

TEST_F(ReferenceLimits, ARampIsHeldAgainstThemAtItsEndAndMovesAddUp) {
  EXPECT_THAT(saidOf("arm_position={weight: 5, reference: {moves: [{at_s: 2, by: [0, 0, 0.3]}, "
                     "{at_s: 3, over_s: 2, by: [0, 0, 0.3]}]}}"),
              HasSubstr("arm_position asks at 5 s for 2.771 rad"));
}

TEST_F(ReferenceLimits, AHandCanPushAndNotPull) {
  EXPECT_EQ(saidOf("contact_force={weight: 1, reference: {moves: [{at_s: 2, by: [3, 0, 5]}]}}"),
            "");
  EXPECT_THAT(saidOf("contact_force={weight: 1, reference: {moves: [{at_s: 2, by: [0, 0, -5]}]}}"),
              HasSubstr("contact_force asks at 2 s for -5 N along the normal, must be at least 0"));
}

TEST_F(ReferenceLimits, AForceBesideItsFrictionConeIsRefused) {
  EXPECT_THAT(saidOf("contact_force={weight: 1, reference: {moves: [{at_s: 2, by: [5, 0, 5]}]}}"),
              HasSubstr("for 5 N across the normal, must be at most 3.5: 0.7"));
}

TEST_F(ReferenceLimits, ATorqueLimitBelowWhatStandingStillTakesIsRefused) {
  robot_.arm_torque_limit = 1;
  EXPECT_THAT(saidOf("preview=false"),
              HasSubstr("to stand still with the arm at (0, -0.6, 2.171) rad"));
  const ConfigNode lqr_tree = parseYaml("{}", "law.yaml");
  ConfigReader lqr(lqr_tree);
  EXPECT_THROW(LqrLawConfig::read(lqr, robot_), InputError);
  robot_ = exampleRobot();
  const ConfigNode tree = parseYaml("{arm_torque_limit_Nm: 1}", "tracker.yaml");
  ConfigReader tracker(tree);
  try {
    TrackerConfig::read(tracker, robot_);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("tracker.yaml:1:23: arm_torque_limit_Nm: to stand still"));
    EXPECT_THAT(e.what(), HasSubstr("must be less than its torque limit of 1 N m"));
  }
}

TEST_F(ReferenceLimits, ATorqueCostsSomethingAtEveryTime) {
  EXPECT_THAT(saidOf("arm_torque={weight: 0}"), HasSubstr("weight is 0, must be more than 0"));
  EXPECT_THAT(saidOf("wheel_torque={weight: 1, weight_changes: [{at_s: 3, weight: 0}]}"),
              HasSubstr("weight is 0, must be more than 0"));
}

}  // namespace
}  // namespace ballbot
