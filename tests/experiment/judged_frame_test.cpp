#include <gmock/gmock.h>

#include "core/error.hpp"
#include "experiment/run_config.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;

RunConfig scenario(const std::string& name, const std::vector<std::string>& changes = {}) {
  return readRunConfig(
      loadScenario(BALLBOT_SOURCE_DIR "/configs/scenarios/" + name + ".yaml", changes));
}

SimTime at(double t) { return kSimStart + durationFromSeconds(t); }

TEST(HomeFrameOf, ARobotWithoutAnOutsidePoseLivesWhereItWasPutDown) {
  EXPECT_EQ(scenario("balance").home.yaw, 0);
  EXPECT_NEAR(scenario("balance", {"initial.yaw_deg=90"}).home.yaw, 0.5 * M_PI, 1e-12);
  EXPECT_EQ(scenario("balance", {"initial.yaw_deg=90", "plant.motion_capture={}",
                                 "estimator.external_pose={}"})
                .home.yaw,
            0);
}

TEST(MotionReference, IsWhatTheTasksSayAtEveryTime) {
  const auto r = scenario("ee_pose_tracking",
                          {"controller.mpc.tasks.ee_position.reference.moves=[{at_s: 2, by: 0.1}, "
                           "{at_s: 4, over_s: 2, by: [0, 0.3, 0]}]"})
                     .reference();
  ASSERT_TRUE(r->eeMoves());
  const auto steps = r->eeSteps();
  ASSERT_EQ(steps.size(), 4u) << "three of the angles' and one of the position's; a ramp is none";
  EXPECT_EQ(steps[0].at, at(2));
  EXPECT_EQ(steps[0].by.head<3>(), Vector3::Constant(0.1)) << "one number for all three";
  EXPECT_LT(
      (r->eePose(at(5)) - r->eePose(at(1)) - (PoseVector() << 0.1, 0.25, 0.1, 0, 0, 0).finished())
          .norm(),
      1e-12);
}

TEST(MotionReference, ALawWithoutTasksAsksForNothing) {
  const auto r = scenario("balance", {"controller.kind=lqr"}).reference();
  EXPECT_FALSE(r->eeMoves());
  EXPECT_TRUE(r->eeSteps().empty());
  EXPECT_TRUE(r->eePose(at(3)).isZero(0));
}

std::string saidOfRates(const std::vector<std::string>& changes) {
  try {
    scenario("balance", changes);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(PlanAge, PlansMustLiveUntilTheNextOnesTakeOver) {
  EXPECT_EQ(saidOfRates({}), "");
  EXPECT_THAT(saidOfRates({"rates.planner_period_us=200000"}),
              HasSubstr("mpc.yaml:13:22: fallback_after_ms is 100, must be at least 212"));
  // Begun every 210 ms, the first time of the planner's at which the one before acts.
  EXPECT_THAT(saidOfRates({"rates.plan_latency_us=200000"}), HasSubstr("must be at least 410"));
  EXPECT_EQ(saidOfRates({"rates.plan_latency_us=200000", "controller.mpc.fallback_after_ms=410"}),
            "");
  EXPECT_EQ(saidOfRates({"rates.planner_period_us=200000", "controller.kind=lqr"}), "");
}

}  // namespace
}  // namespace ballbot
