// Plant and FMUs coupled as a run couples them, each FMU in a process of its own.
#include "fmi/coupled_plant.hpp"

#include <gmock/gmock.h>
#include <signal.h>

#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "plant/plant.hpp"
#include "tests/fmi/fmu_fixture.hpp"
#include "tests/fmi/small_fmus.hpp"
#include "tests/fmi/spring_support.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

constexpr SimDuration kStep{400'000};
const char* const kProgram = BALLBOT_BIN_DIR "/ballbot";

SimTime at(int step) { return kSimStart + step * kStep; }

ConfigNode scenarioWith(const std::string& fmus) {
  ConfigNode scenario = testScenario();
  applyOverride(scenario, "fmus=[" + fmus + "]");
  return scenario;
}
std::string spring(const std::string& parameters, const std::string& connections,
                   const char* patience_s = "60") {
  return "{name: spring, file: '" + springFmu() + "', patience_s: " + patience_s +
         ", parameters: {" + parameters + "}, connections: [" + connections + "]}";
}
CoupledPlant coupledPlant(const ConfigNode& scenario) {
  return CoupledPlant(planCoupling(scenario), readPlantConfig(scenario), kProgram);
}

const char* const kHandToSpring = "{from: plant.truth.p_WE, to: spring.hand}";
const char* const kSpringToHand = "{from: spring.force, to: plant.force.end_effector_W}";
std::string bothWays() { return std::string(kHandToSpring) + ", " + kSpringToHand; }

// What an FMU calls local, such as our plant's true state, has no dependencies on record.
std::string delayedWays() {
  return kHandToSpring +
         std::string(", {from: spring.force, to: plant.force.end_effector_W, delay_steps: 1}");
}

std::string plantFmu(int version) {
  return "{name: plant, file: '" + unpackedFmu(version).file + "'}";
}

ActuatorCommand commandOf(int step) {
  ActuatorCommand c;
  c.torque << 0.1, -0.2, 0.05 * step, 0.5, -1, 0.3;
  c.stiffness.tail<3>().setConstant(8);
  c.position.tail<3>() << 0, -0.6, 2.17;
  return c;
}

void steps(Participant& plant, int first, int last) {
  for (int k = first; k <= last; ++k) plant.doStep(at(k - 1), kStep, commandOf(k));
}

class PlantFmuAsPlant : public ::testing::TestWithParam<int> {};

TEST_P(PlantFmuAsPlant, IsTheNativePlantToTheBit) {
  CoupledPlant imported = coupledPlant(scenarioWith(plantFmu(GetParam())));
  Plant native(readPlantConfig(testScenario()));
  imported.enterInitializationMode(kSimStart);
  native.reset(kSimStart);
  EXPECT_EQ(imported.stateDigest(), native.stateDigest());
  for (int k = 1; k <= 100; ++k) {
    steps(imported, k, k);
    native.advanceTo(at(k), commandOf(k));
    ASSERT_EQ(imported.stateDigest(), native.stateDigest()) << k;
    ASSERT_EQ(imported.sensors().gyro_WB_B, native.sensors().gyro_WB_B) << k;
    ASSERT_EQ(imported.sensors().imu_time, native.sensors().imu_time) << k;
    ASSERT_EQ(imported.truth()->state, native.truth().state) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Fmi, PlantFmuAsPlant, ::testing::Values(2, 3),
                         [](const auto& version) { return std::to_string(version.param); });

// The law of the coupling: what acts on the plant during a step is what the spring makes of the
// plant's own values at the beginning of that step.
TEST(CoupledPlant, AForceFollowsFromThePlantsValuesOfTheSameInstant) {
  CoupledPlant plant =
      coupledPlant(scenarioWith(spring("stiffness: 40, 'anchor[3]': 2", bothWays())));
  plant.enterInitializationMode(kSimStart);
  for (int k = 1; k <= 80; ++k) {
    const Vector3 expected = 40 * (Vector3(0, 0, 2) - plant.truth()->p_WE);
    steps(plant, k, k);
    ASSERT_EQ(plant.truth()->external_force_W, expected) << k;
  }
}

TEST(CoupledPlant, ADelayedForceIsThatOfTheStepBefore) {
  const std::string delayed =
      "{from: spring.force, to: plant.force.end_effector_W, delay_steps: 1}";
  CoupledPlant plant =
      coupledPlant(scenarioWith(spring("stiffness: 40", kHandToSpring + (", " + delayed))));
  plant.enterInitializationMode(kSimStart);
  Vector3 before = plant.truth()->p_WE;
  steps(plant, 1, 50);
  for (int k = 51; k <= 80; ++k) {
    const Vector3 now = plant.truth()->p_WE;
    steps(plant, k, k);
    if (k > 51) {
      ASSERT_EQ(plant.truth()->external_force_W, Vector3(-40 * before)) << k;
    }
    before = now;
  }
}

// Another importer of the same equations: the plant, told the spring's force by hand.
TEST(CoupledPlant, IsThePlantWithTheForceAppliedByHand) {
  CoupledPlant coupled =
      coupledPlant(scenarioWith(spring("stiffness: 40, 'anchor[1]': 0.5", bothWays())));
  Plant native(readPlantConfig(testScenario()));
  coupled.enterInitializationMode(kSimStart);
  native.reset(kSimStart);
  for (int k = 1; k <= 100; ++k) {
    ExternalForces forces;
    forces.end_effector_force_W = 40 * (Vector3(0.5, 0, 0) - native.truth().p_WE);
    native.setExternalForces(forces);
    native.advanceTo(at(k), commandOf(k));
    steps(coupled, k, k);
    ASSERT_EQ(coupled.truth()->state, native.truth().state) << k;
  }
}

TEST(CoupledPlant, ContinuesToTheBitAlsoInOtherProcesses) {
  for (const std::string& fmus :
       {spring("stiffness: 40", bothWays()),
        plantFmu(2) + ", " + spring("stiffness: 40", delayedWays()), plantFmu(3)}) {
    const ConfigNode scenario = scenarioWith(fmus);
    CoupledPlant whole = coupledPlant(scenario);
    whole.enterInitializationMode(kSimStart);
    steps(whole, 1, 60);
    const StateBlob middle = whole.saveState();
    steps(whole, 61, 100);
    const std::uint64_t digest = whole.stateDigest();
    const StateBlob end = whole.saveState();
    whole.restoreState(middle);
    steps(whole, 61, 100);
    EXPECT_EQ(whole.stateDigest(), digest);

    CoupledPlant other = coupledPlant(scenario);
    other.enterInitializationMode(kSimStart);
    other.restoreState(middle);
    steps(other, 61, 100);
    EXPECT_EQ(other.stateDigest(), digest);
    EXPECT_EQ(other.saveState(), end);
  }
}

TEST(CoupledPlant, AForeignStateIsRefused) {
  CoupledPlant one = coupledPlant(scenarioWith(spring("", bothWays())));
  CoupledPlant other =
      coupledPlant(scenarioWith(spring("", "{from: spring.force, to: plant.force.base_W}")));
  one.enterInitializationMode(kSimStart);
  other.enterInitializationMode(kSimStart);
  EXPECT_THAT(messageOf([&] { other.restoreState(StateBlob(100, 1)); }),
              HasSubstr("coupled plant"));
}

// Whatever an FMU does to its process is an error in words here.
TEST(CoupledPlant, TroubleInAnFmuIsAnErrorInWords) {
  const auto words = [](int trouble, const char* patience_s) {
    const std::string parameters = "trouble: " + std::to_string(trouble) + ", trouble_time: 0.01";
    CoupledPlant plant = coupledPlant(scenarioWith(spring(parameters, bothWays(), patience_s)));
    plant.enterInitializationMode(kSimStart);
    return messageOf([&] { steps(plant, 1, 100); });
  };
  EXPECT_THAT(words(1, "60"),
              HasSubstr("its process ended when asked to step (signal 6, Aborted)"));
  EXPECT_THAT(words(2, "4"),
              HasSubstr("no answer to 'step' within 4000 ms; its process was ended"));
  EXPECT_THAT(words(3, "60"), HasSubstr("its process ended when asked to step (exit code 0)"));
  EXPECT_THAT(words(4, "60"), HasSubstr("FMU 'spring': "));
  EXPECT_THAT(words(4, "60"), HasSubstr("fmi2DoStep returned an error"));
}

TEST(CoupledPlant, SaysWhatIsWrongWithTheConnections) {
  const auto words = [](const std::string& fmus) {
    return messageOf([&] { planCoupling(scenarioWith(fmus)); });
  };
  const auto connected = [&](const std::string& connection) {
    return words(spring("", connection));
  };
  EXPECT_THAT(connected("{from: plant.truth.p_WF, to: spring.hand}"),
              HasSubstr("'plant' has no output 'truth.p_WF'; did you mean 'plant.truth.p_WE'?"));
  EXPECT_THAT(connected("{from: plant.truth.p_WE, to: spring.hnd}"),
              HasSubstr("has no variable 'hnd'; did you mean 'hand"));
  EXPECT_THAT(connected("{from: plant.truth.base_angles, to: spring.hand}"),
              HasSubstr("'plant.truth.base_angles' is in rad, but 'spring.hand' in m"));
  EXPECT_THAT(connected("{from: plant.truth.p_WE, to: spring.anchor}"),
              HasSubstr("'spring.anchor' is no input, but a parameter; set it under 'parameters'"));
  EXPECT_THAT(connected("{from: spring.hand, to: plant.force.base_W}"), HasSubstr("is no output"));
  EXPECT_THAT(connected("{from: 'plant.truth.p_WE[1]', to: 'spring.hand[1]'}"),
              HasSubstr("only some elements of 'spring.hand' are connected"));
  EXPECT_THAT(connected("{from: spring.force, to: plant.force.end_effector_W, delay_steps: 3}"),
              HasSubstr("delay_steps is 3, must be between 0 and 1"));
  EXPECT_THAT(words(spring("stifness: 3", "")), HasSubstr("did you mean 'stiffness'?"));
  EXPECT_THAT(words("{name: spring, file: nowhere.fmu}"),
              HasSubstr("there is no file 'nowhere.fmu'"));
  EXPECT_THAT(words("{name: controller, file: '" + springFmu() + "'}"),
              HasSubstr("stands for something else"));
  EXPECT_THAT(
      words("{name: plant, file: '" + springFmu() + "'}"),
      HasSubstr("the plant's FMU has no 'sensors.motor_angle', and no connection brings it"));
  EXPECT_THAT(words("{name: spring, fil: x}"),
              HasSubstr("unknown key 'fil'; did you mean 'file'?"));
}

std::string values(const std::string& connections) {
  return "{name: values, file: '" + valuesFmu() + "', patience_s: 60, connections: [" +
         connections + "]}";
}

TEST(CoupledPlant, AnElementOfAMatrixIsCountedRowByRow) {
  for (const auto& [element, force] : std::vector<std::pair<std::string, double>>{
           {"A[1,2]", 10}, {"A[2,1]", 30}, {"A[3,3]", 80}, {"A[4]", 30}}) {
    CoupledPlant plant = coupledPlant(
        scenarioWith(values("{from: 'values." + element + "', to: 'plant.force.base_W[1]'}")));
    plant.enterInitializationMode(kSimStart);
    steps(plant, 1, 1);
    EXPECT_EQ(plant.truth()->external_force_W[0], force) << element;
  }
  for (const char* none : {"A[1,4]", "A[2x]", "A[2][1]", "A[0]", "A[10]", "A[1,2,3]"}) {
    const std::string line =
        std::string("{from: 'values.") + none + "', to: 'plant.force.base_W[1]'}";
    EXPECT_THAT(messageOf([&] { planCoupling(scenarioWith(values(line))); }),
                ::testing::AnyOf(HasSubstr("has no output"), HasSubstr("has no variable")))
        << none;
  }
}

TEST(CoupledPlant, AnAliasIsTheSameVariable) {
  const std::string file = fmi3File("alias",
                                    "<Float64 name=\"u\" valueReference=\"1\" causality=\"input\">"
                                    "<Alias name=\"hand.x\"/></Float64>");
  const auto words = [&](const std::string& lines) {
    return messageOf([&] {
      planCoupling(scenarioWith("{name: g, file: '" + file + "', connections: [" + lines + "]}"));
    });
  };
  const std::string to_alias = "{from: 'plant.truth.p_WE[1]', to: g.hand.x}";
  EXPECT_EQ(words(to_alias), "nothing was thrown");
  EXPECT_THAT(words(to_alias + ", {from: 'plant.truth.p_WE[2]', to: g.u}"),
              HasSubstr("'g.u' has another source already"));
}

TEST(CoupledPlant, WhatWouldLoseSomethingIsRefusedBeforeItRuns) {
  const auto words = [](const std::string& fmus) {
    return messageOf([&] { planCoupling(scenarioWith(fmus)); });
  };
  EXPECT_THAT(words(spring("trouble: 3.7", "")),
              HasSubstr("parameter 'trouble' is 3.7, must be a whole number between"));
  EXPECT_THAT(words(spring("trouble: 1e20", "")), HasSubstr("must be a whole number between"));
  EXPECT_THAT(words(values("{from: 'plant.truth.p_WE[1]', to: values.in_Int8}")),
              HasSubstr("is a real number, but 'values.in_Int8' takes a whole number"));
  EXPECT_THAT(words(values("{from: plant.sensors.imu_count, to: values.in_Boolean}")),
              HasSubstr("is a whole number, but 'values.in_Boolean' takes true or false"));
  EXPECT_EQ(words(values("{from: plant.sensors.imu_count, to: values.in_Int64}")),
            "nothing was thrown");
  const std::string file =
      fmi2File("lossy",
               scalar("flag", "parameter", "Boolean") + scalar("text", "input", "String") +
                   scalar("mode", "parameter", "Enumeration declaredType=\"M\"") +
                   scalar("gain", "parameter", "Real min=\"0\" max=\"2\""),
               "<TypeDefinitions><SimpleType name=\"M\"><Enumeration><Item name=\"a\" value=\"1\"/>"
               "<Item name=\"b\" value=\"2\"/></Enumeration></SimpleType></TypeDefinitions>");
  const auto with = [&](const std::string& parameters, const std::string& lines = "") {
    return words("{name: g, file: '" + file + "', parameters: {" + parameters +
                 "}, connections: [" + lines + "]}");
  };
  EXPECT_THAT(with("flag: 2"), HasSubstr("parameter 'flag' is 2, must be true or false"));
  EXPECT_EQ(with("flag: true, mode: 2, gain: 1.5"), "nothing was thrown");
  EXPECT_THAT(with("mode: 7"), HasSubstr("must be one of the numbers of its enumeration: 1, 2"));
  EXPECT_THAT(with("gain: 3"), HasSubstr("parameter 'gain' is 3, must be between 0 and 2"));
  EXPECT_THAT(with("", "{from: 'plant.truth.p_WE[1]', to: g.text}"),
              HasSubstr("'g.text' is of type String"));
}

// A run whose scenario says one thing and whose plant is another would pass a test of pushes
// without a push.
TEST(CoupledPlant, AnFmuInThePlantsPlaceIsThePlantOfTheScenario) {
  const auto words = [](const std::string& change, const std::string& parameters = "") {
    ConfigNode scenario = scenarioWith("{name: plant, file: '" + unpackedFmu(2).file +
                                       "', parameters: {" + parameters + "}}");
    if (!change.empty()) applyOverride(scenario, change);
    return messageOf([&] { planCoupling(scenario); });
  };
  const std::string push =
      "environment.pushes=[{body: base, point_m: [0, 0, 0], force_N: [0, 20, 0], start_s: 1, "
      "duration_s: 0.5}]";
  EXPECT_EQ(words(""), "nothing was thrown");
  EXPECT_THAT(words(push), HasSubstr("is not the plant of this scenario: environment.pushes is a "
                                     "list in the scenario"));
  EXPECT_THAT(words(push), HasSubstr("nothing in the FMU"));
  EXPECT_THAT(words("seed=7"), HasSubstr("seed is 7 in the scenario, 1 in the FMU"));
  EXPECT_EQ(words("seed=7", "seed: 7"), "nothing was thrown");
  EXPECT_EQ(words("environment.payload_kg=0.0"), "nothing was thrown") << "as it is by default";
  EXPECT_THAT(words("plant.fidelity.friction=false"),
              HasSubstr("plant.fidelity.friction is false"));
}

TEST(CoupledPlant, AForeignPlantCannotBeKnownToHoldTheEnvironment) {
  ConfigNode scenario = testScenario();
  const std::string ours = unpackedFmu(2).file;
  const std::string xml = readFromZip(ours, "modelDescription.xml", 1U << 20);
  const std::string foreign = smallFmuFolder() + "/foreign.fmu";
  writeZip(foreign, {{"modelDescription.xml", xml}, {"binaries/linux64/ballbot_plant.so", "none"}});
  applyOverride(scenario, "fmus=[{name: plant, file: '" + foreign + "'}]");
  EXPECT_EQ(messageOf([&] { planCoupling(scenario); }), "nothing was thrown");
  applyOverride(scenario, "environment.payload_kg=1");
  EXPECT_THAT(messageOf([&] { planCoupling(scenario); }),
              HasSubstr("the scenario has 'environment'"));
}

}  // namespace
}  // namespace ballbot
