#include "experiment/run_config.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

RunConfig config(const std::vector<std::string>& changes) {
  return readRunConfig(loadScenario(BALLBOT_SOURCE_DIR "/configs/scenarios/balance.yaml", changes));
}

std::string said(const std::vector<std::string>& changes) {
  try {
    config(changes);
  } catch (const InputError& e) {
    return e.what();
  }
  return "nothing";
}

// One robot, three beliefs: what it is, what it carries, what the controller counts on.
TEST(RunConfig, TellsTheRobotsApart) {
  const RunConfig c = config({"environment.payload_kg=1", "controller.known_payload_kg=0.4",
                              "plant.base_com_offset_m=[0.003, 0, 0]"});
  EXPECT_EQ(c.robot.payload_mass, 0);
  EXPECT_EQ(c.believedRobot().payload_mass, 0.4);
  EXPECT_EQ(c.plant.plant.robot.payload_mass, 1);
  EXPECT_NEAR(c.plant.plant.robot.base.p_LLcm_L.x() - c.robot.base.p_LLcm_L.x(), 0.003, 1e-12);
}

TEST(RunConfig, RecordsAsOftenAsTheEstimatorRunsIfNothingIsSaid) {
  EXPECT_EQ(config({"recording=null", "rates.estimator_period_us=1250",
                    "robot.sensors.imu.period_ms=2.5"})
                .recording.log.sensors,
            std::chrono::microseconds(1250));
  EXPECT_EQ(config({"recording.sensors_period_ms=10"}).recording.log.sensors,
            std::chrono::milliseconds(10));
}

TEST(RunConfig, EveryPartSaysWhereItsFaultStands) {
  EXPECT_THAT(said({"robot.gravity_m_per_s2=-1"}), HasSubstr("gravity_m_per_s2 is -1"));
  EXPECT_THAT(said({"plant.fidelity.contact=soft"}), HasSubstr("contact is 'soft'"));
  EXPECT_THAT(said({"estimator.iterations=0"}), HasSubstr("iterations is 0"));
  EXPECT_THAT(said({"controller.mpc.horizon.length_s=0"}), HasSubstr("length_s is 0"));
  EXPECT_THAT(said({"controller.tracker.stiff=1"}), HasSubstr("unknown key 'stiff'"));
  EXPECT_THAT(said({"recording.truth_period_ms=soon"}), HasSubstr("recording.truth_period_ms"));
  EXPECT_THAT(said({"environment.pushes=[{body: head}]"}), HasSubstr("body is 'head'"));
}

// What no part can see alone.
TEST(RunConfig, PartsMustFitEachOther) {
  EXPECT_THAT(said({"robot.sensors.imu.period_ms=1"}),
              HasSubstr("the estimator looks once in 2.5 ms"));
  EXPECT_THAT(said({"rates.planner_period_us=200000"}), HasSubstr("fallback_after_ms"));
}

TEST(RunConfig, ThePlantsPartCanBeReadAlone) {
  const Scenario scenario = loadScenario(BALLBOT_SOURCE_DIR "/configs/scenarios/balance.yaml",
                                         {"controller.kind=nonsense", "seed=7"});
  EXPECT_EQ(readPlantSetup(scenario).plant.seed, 7u);
}

}  // namespace
}  // namespace ballbot
