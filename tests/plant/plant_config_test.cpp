#include "plant/plant_config.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "plant/plant_participant.hpp"
#include "support/plant_fixture.hpp"

namespace ballbot {
namespace {

std::string errorOf(const std::vector<std::string>& overrides) {
  try {
    plantConfig("full", overrides);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

void expectError(const std::string& override_text, const std::string& words) {
  const std::string text = errorOf({override_text});
  EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST(PlantConfig, ReadsTheFilesThatShip) {
  const PlantConfig full = plantConfig("full");
  EXPECT_EQ(full.fidelity.multibody, MultibodyStructure::kFull);
  EXPECT_EQ(full.fidelity.actuators, ActuatorLevel::kSeriesElastic);
  EXPECT_TRUE(full.fidelity.noisy_sensors && full.fidelity.friction && full.fidelity.saturation &&
              full.fidelity.speed_limit && full.fidelity.transport_delay &&
              full.fidelity.encoder_quantisation);
  EXPECT_EQ(full.actuators.wheel.torque_bandwidth, 40);
  EXPECT_EQ(full.initial.pose.arm, full.robot.nominal_arm);

  const PlantConfig ideal = plantConfig("ideal");
  EXPECT_EQ(ideal.fidelity.actuators, ActuatorLevel::kIdeal);
  EXPECT_FALSE(ideal.fidelity.noisy_sensors || ideal.fidelity.friction ||
               ideal.fidelity.saturation || ideal.fidelity.speed_limit ||
               ideal.fidelity.transport_delay || ideal.fidelity.encoder_quantisation);
}

TEST(PlantConfig, PayloadOfTheEnvironmentTakesTheModelsPlace) {
  EXPECT_EQ(plantConfig("full", {"robot.payload_mass_kg=1"}).robot.payload_mass, 1);
  EXPECT_EQ(plantConfig("full", {"robot.payload_mass_kg=1", "environment={payload_kg: 0.2}"})
                .robot.payload_mass,
            0.2);
}

TEST(PlantConfig, BaseMayBeOffFromItsModel) {
  const PlantConfig off = plantConfig("full", {"plant.base_com_offset_m=[0.003, 0.0033, 0]"});
  const Vector3 moved = off.robot.base.p_LLcm_L - plantConfig("full").robot.base.p_LLcm_L;
  EXPECT_LT((moved - Vector3(0.003, 0.0033, 0)).norm(), 1e-15);
}

TEST(PlantConfig, NamesWhatIsWrong) {
  expectError("plant.fidelity.multibody=rigid",
              "multibody is 'rigid', must be one of: full, reduced_wheels");
  expectError("plant.fidelity.actuators=elastic", "must be one of: ideal, series_elastic");
  expectError("plant.fidelity.frictoin=true", "unknown key 'frictoin'");
  expectError("plant.substep_us=0", "substep_us is 0, must be");
  expectError("plant.transport_delay_ticks=-1", "transport_delay_ticks is -1, must be");
  expectError("initial={pitch_deg: 90}", "pitch_deg is 90, must be between -60 and 60");
  expectError("initial={arm_rad: [0, 0, 3]}", "puts 'arm_3' at 3 rad, must be between 0 and 2.6");
  expectError("robot.sensors.imu.period_ms=-1", "period_ms is -1, must be");
  expectError("environment={wind: 3}", "unknown key 'wind'");
}

TEST(PlantConfig, NamesWhatIsWrongWithAPush) {
  const auto push = [](const std::string& body, const std::string& rest) {
    return "environment={pushes: [{body: " + body + ", force_N: [1, 0, 0], " + rest + "}]}";
  };
  expectError(push("head", "start_s: 1, duration_s: 1"),
              "body is 'head', must be one of: ball, base, arm_1, arm_2, arm_3");
  expectError(push("base", "start_s: 1"), "key 'duration_s' is missing in 'environment.pushes.0'");
  expectError(push("base", "start_s: -1, duration_s: 1"), "start_s is -1, must be");
}

TEST(Environment, ListsAScenariosPushes) {
  const ConfigNode scenario = plantScenario(
      "full",
      {"environment={pushes: [{body: base, point_m: [0, 0, 0.35], force_N: [0, 20, 0], start_s: 2, "
       "duration_s: 0.5}, {body: arm_2, force_N: [1, 2, 3], start_s: 2.2, duration_s: 1}]}"});
  const std::vector<Push> pushes = readPlantConfig(scenario).pushes;
  ASSERT_EQ(pushes.size(), 2u);
  EXPECT_EQ(pushes[0].p_BP_B, Vector3(0, 0, 0.35));
  EXPECT_EQ(pushes[1].body, armBody(1));

  const Environment environment(pushes);
  const auto at = [](double s) { return kSimStart + durationFromSeconds(s); };
  EXPECT_EQ(environment.nextChange(at(0)), at(2));
  EXPECT_EQ(environment.nextChange(at(2)), at(2.2));
  EXPECT_EQ(environment.nextChange(at(2.2)), at(2.5));
  EXPECT_EQ(environment.nextChange(at(2.5)), at(3.2));
  EXPECT_EQ(environment.nextChange(at(3.2)), SimTime::max());
  EXPECT_EQ(environment.totalForce(at(1.999)), Vector3::Zero());
  EXPECT_EQ(environment.totalForce(at(2)), Vector3(0, 20, 0));
  EXPECT_EQ(environment.totalForce(at(2.3)), Vector3(1, 22, 3));
  EXPECT_EQ(environment.totalForce(at(2.5)), Vector3(1, 2, 3));
  EXPECT_TRUE(readPlantConfig(plantScenario("full")).pushes.empty());
}

TEST(PlantParticipant, IsThePlantOfItsScenario) {
  const ConfigNode scenario = plantScenario("full", {"initial={pitch_deg: 3}"});
  const std::unique_ptr<Participant> participant =
      std::make_unique<PlantParticipant>(readPlantConfig(scenario));
  Plant plant(readPlantConfig(scenario));
  participant->enterInitializationMode(kSimStart);
  participant->exitInitializationMode();
  ActuatorCommand command;
  command.torque.setConstant(0.2);
  participant->doStep(kSimStart, SimDuration{2'000'000}, command);
  plant.advanceTo(kSimStart + SimDuration{2'000'000}, command);
  EXPECT_EQ(participant->stateDigest(), plant.stateDigest());
  EXPECT_EQ(participant->sensors().joint_angle, plant.sensors().joint_angle);
  ASSERT_TRUE(participant->truth());
  EXPECT_EQ(participant->truth()->state, plant.truth().state);

  participant->reset();
  participant->enterInitializationMode(kSimStart + SimDuration{5'000'000});
  try {
    participant->doStep(kSimStart, SimDuration{1'000'000}, command);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "plant: asked to step from 0.000000 s, but it stands at 0.005000 s");
  }
}

}  // namespace
}  // namespace ballbot
