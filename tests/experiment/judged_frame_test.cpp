#include <gmock/gmock.h>

#include "core/error.hpp"
#include "experiment/ee_reference.hpp"
#include "experiment/plan_age.hpp"
#include "experiment/scenario_frame.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;

Scenario scenario(const std::string& name, const std::vector<std::string>& changes = {}) {
  return loadScenario(BALLBOT_SOURCE_DIR "/configs/scenarios/" + name + ".yaml", changes);
}

SimTime at(double t) { return kSimStart + durationFromSeconds(t); }

TEST(HomeFrameOf, ARobotWithoutAnOutsidePoseLivesWhereItWasPutDown) {
  EXPECT_EQ(homeFrame(scenario("balance")).yaw, 0);
  EXPECT_NEAR(homeFrame(scenario("balance", {"initial.yaw_deg=90"})).yaw, 0.5 * M_PI, 1e-12);
  EXPECT_EQ(homeFrame(scenario("balance", {"initial.yaw_deg=90", "plant.motion_capture={}",
                                           "estimator.external_pose={}"})).yaw, 0);
}

TEST(EeReference, IsWhatTheTasksSayAtEveryTime) {
  const EeReference r = readEeReference(scenario(
      "ee_pose_tracking",
      {"controller.mpc.tasks.ee_position.reference.moves=[{at_s: 2, by: 0.1}, "
       "{at_s: 4, over_s: 2, by: [0, 0.3, 0]}]"}));
  ASSERT_TRUE(r.moves());
  const auto steps = r.steps();
  ASSERT_EQ(steps.size(), 4u) << "three of the angles' and one of the position's; a ramp is none";
  EXPECT_EQ(steps[0].at, at(2));
  EXPECT_EQ(steps[0].by.head<3>(), Vector3::Constant(0.1)) << "one number for all three";
  EXPECT_LT((r.at(at(5)) - r.at(at(1)) - (PoseVector() << 0.1, 0.25, 0.1, 0, 0, 0).finished()).norm(),
            1e-12);
}

TEST(EeReference, ALawWithoutTasksAsksForNothing) {
  const EeReference r = readEeReference(scenario("balance", {"controller.kind=lqr"}));
  EXPECT_FALSE(r.moves());
  EXPECT_TRUE(r.steps().empty());
  EXPECT_TRUE(r.at(at(3)).isZero(0));
}

std::string saidOfRates(const std::vector<std::string>& changes) {
  try {
    requireYoungPlans(scenario("balance", changes));
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
  EXPECT_EQ(saidOfRates({"rates.plan_latency_us=200000", "controller.mpc.fallback_after_ms=410"}), "");
  EXPECT_EQ(saidOfRates({"rates.planner_period_us=200000", "controller.kind=lqr"}), "");
}

}  // namespace
}  // namespace ballbot
