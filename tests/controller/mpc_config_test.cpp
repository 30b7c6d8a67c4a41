#include <gmock/gmock.h>

#include "controller/mpc_planner.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "tests/model/robot_fixture.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;

class MpcConfigTest : public testing::Test {
 protected:
  MpcConfig config() {
    ConfigReader in(tree_);
    ConfigReader mpc = in.child("mpc");
    return MpcConfig::read(mpc, robot_);
  }

  RobotParameters robot_ = exampleRobot();
  ConfigNode tree_ = loadYamlFile(BALLBOT_SOURCE_DIR "/configs/controllers/mpc.yaml");
};

TEST_F(MpcConfigTest, AContactTaskNeedsContactForces) {
  applyOverride(tree_, "mpc.tasks.contact_force={weight: 1}");
  try {
    config();
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("contact_force needs controller.mpc.contact_forces: true"));
  }
}

TEST_F(MpcConfigTest, ATorqueMustCostSomething) {
  applyOverride(tree_, "mpc.tasks={ball_position: {weight: 1}, wheel_torque: {weight: 1}}");
  try {
    config();
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("arm_torque is missing: a torque must cost something"));
  }
}

TEST_F(MpcConfigTest, APlanCannotActBeyondItsEnd) {
  applyOverride(tree_, "mpc.fallback_after_ms=1200");
  try {
    config();
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(),
                HasSubstr("fallback_after_ms is 1200, which is beyond the end of a plan"));
  }
}

TEST_F(MpcConfigTest, AHorizonMustBeWholeSteps) {
  applyOverride(tree_, "mpc.horizon.step_ms=30");
  try {
    config();
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("length_s leaves 33.3333 steps of 30 ms"));
  }
}

TEST_F(MpcConfigTest, GuessesWhichTaskWasMeant) {
  applyOverride(tree_, "mpc.tasks.ball_positon={weight: 1}");
  try {
    config();
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("unknown key 'ball_positon'"));
    EXPECT_THAT(e.what(), HasSubstr("did you mean 'ball_position'?"));
  }
}

}  // namespace
}  // namespace ballbot
