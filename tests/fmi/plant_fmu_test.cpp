// What holds for the FMU of both versions, through the face our own importer has.
#include <gmock/gmock.h>

#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "fmi/fmu_slave.hpp"
#include "fmi/plant_parameters.hpp"
#include "model/signal_table.hpp"
#include "plant/plant.hpp"
#include "tests/fmi/fmu_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

constexpr SimDuration kStep{2'500'000};

class PlantFmuTest : public ::testing::TestWithParam<int> {
 protected:
  const UnpackedFmu& fmu() { return unpackedFmu(GetParam()); }
  FmuPort port(const std::string& name) { return findPort(fmu().description, name); }
  std::unique_ptr<FmuSlave> load() { return loadFmu(fmu().description, fmu().folder, "one", {}); }

  void command(FmuSlave& slave, int step) {
    const std::vector<double> values = busyCommand(step);
    std::size_t at = 0;
    for (const auto& s : commandSignals()) {
      slave.set(port(std::string("command.") + s.name), &values[at]);
      at += static_cast<std::size_t>(s.size);
    }
  }
  /// Steps number `first` to `last`.
  void run(FmuSlave& slave, int first, int last) {
    for (int k = first; k <= last; ++k) {
      command(slave, k);
      slave.doStep(kSimStart + (k - 1) * kStep, kStep);
    }
  }
  /// All outputs, the true state and the digest.
  std::vector<double> observed(FmuSlave& slave) {
    std::vector<double> out;
    for (const ImportedVariable& v : fmu().description.variables) {
      if (v.role != VariableRole::kOutput && v.role != VariableRole::kLocal) continue;
      FmuPort one;
      one.variables = {v};
      out.resize(out.size() + static_cast<std::size_t>(v.size));
      slave.get(one, &out[out.size() - static_cast<std::size_t>(v.size)]);
    }
    return out;
  }
};

ActuatorCommand commandOf(int step) {
  const std::vector<double> values = busyCommand(step);
  ActuatorCommand command;
  std::size_t at = 0;
  for (const auto& s : commandSignals()) {
    s.write(command, &values[at]);
    at += static_cast<std::size_t>(s.size);
  }
  return command;
}

TEST_P(PlantFmuTest, IsTheNativePlantToTheBit) {
  ConfigNode scenario = testScenario();
  Plant plant(readPlantConfig(scenario));
  plant.reset(kSimStart);
  const auto slave = load();
  slave->initialize(kSimStart);
  for (int k = 1; k <= 60; ++k) {
    plant.advanceTo(kSimStart + k * kStep, commandOf(k));
    run(*slave, k, k);
    const auto expectSame = [&](const char* prefix, const auto& signals, const auto& frame) {
      for (const auto& s : signals) {
        double native[6], imported[6];
        s.read(frame, native);
        slave->get(port(std::string(prefix) + s.name), imported);
        for (int i = 0; i < s.size; ++i)
          ASSERT_EQ(native[i], imported[i]) << s.name << " after step " << k;
      }
    };
    expectSame("sensors.", sensorSignals(), plant.sensors());
    expectSame("truth.", truthSignals(), plant.truth());
    double halves[2];
    slave->get(port("state_digest"), halves);
    const auto word = [](double x) {
      return static_cast<std::uint64_t>(static_cast<std::uint32_t>(static_cast<std::int32_t>(x)));
    };
    ASSERT_EQ(word(halves[1]) << 32 | word(halves[0]), plant.stateDigest());
  }
}

TEST_P(PlantFmuTest, ForcesActOnTheRobot) {
  const auto free = load(), pushed = load();
  free->initialize(kSimStart);
  pushed->initialize(kSimStart);
  const double force[3] = {0, 20, 0}, point[3] = {0, 0, 0.35};
  pushed->set(port("force.base_W"), force);
  pushed->set(port("force.base_point_B"), point);
  run(*free, 1, 40);
  run(*pushed, 1, 40);
  double v_free[2], v_pushed[2], recorded[3];
  free->get(port("truth.ball_velocity_W"), v_free);
  pushed->get(port("truth.ball_velocity_W"), v_pushed);
  pushed->get(port("truth.external_force_W"), recorded);
  EXPECT_GT(std::abs(v_pushed[1] - v_free[1]), 0.01);
  EXPECT_EQ(recorded[1], 20);
}

TEST_P(PlantFmuTest, ResetAndASecondAndAnInterleavedInstanceRepeatTheBits) {
  const auto one = load(), two = load();
  one->initialize(kSimStart);
  two->initialize(kSimStart);
  for (int k = 1; k <= 20; ++k) {
    run(*one, k, k);
    if (k % 2 == 0) run(*two, k - 1, k);
  }
  const std::vector<double> expected = observed(*one);
  EXPECT_EQ(observed(*two), expected);
  one->reset();
  one->initialize(kSimStart);
  run(*one, 1, 20);
  EXPECT_EQ(observed(*one), expected);
}

TEST_P(PlantFmuTest, RestoredStatesContinueToTheBit) {
  const auto whole = load();
  whole->initialize(kSimStart);
  run(*whole, 1, 10);
  const StateBlob middle = whole->saveState();
  run(*whole, 11, 20);
  const std::vector<double> expected = observed(*whole);
  whole->terminate();
  whole->restoreState(middle);  // from terminated
  run(*whole, 11, 20);
  EXPECT_EQ(observed(*whole), expected);
  whole->restoreState(middle);
  EXPECT_THAT(messageOf([&] { whole->doStep(kSimStart, kStep); }),
              HasSubstr("but the plant stands at"));
  whole->restoreState(middle);  // after an error
  run(*whole, 11, 20);
  EXPECT_EQ(observed(*whole), expected);

  const auto fresh = load();  // right after instantiation
  fresh->restoreState(middle);
  EXPECT_EQ(fresh->saveState(), middle);
  run(*fresh, 11, 20);
  EXPECT_EQ(observed(*fresh), expected);
}

// A parameter counts in the state: what was restored is the plant it was saved from.
TEST_P(PlantFmuTest, ParametersActAndAreSavedWithTheState) {
  const double ideal = 1, soft = 100;
  const auto changed = load(), plain = load();
  changed->set(port("plant.fidelity.sensors"), &ideal);
  changed->set(port("robot.actuators.wheel.spring_stiffness_Nm_per_rad"), &soft);
  changed->initialize(kSimStart);
  plain->initialize(kSimStart);
  run(*changed, 1, 20);
  run(*plain, 1, 20);
  EXPECT_NE(observed(*changed), observed(*plain));

  ConfigNode scenario = testScenario();
  applyOverride(scenario, "plant.fidelity.sensors=perfect");
  applyOverride(scenario, "robot.actuators.wheel.spring_stiffness_Nm_per_rad=100");
  Plant native(readPlantConfig(scenario));
  native.reset(kSimStart);
  for (int k = 1; k <= 20; ++k) native.advanceTo(kSimStart + k * kStep, commandOf(k));
  double angle[6];
  changed->get(port("sensors.motor_angle"), angle);
  EXPECT_EQ(Eigen::Map<JointVector>(angle), native.sensors().motor_angle);

  plain->restoreState(changed->saveState());
  EXPECT_EQ(observed(*plain), observed(*changed));
  run(*plain, 21, 25);
  run(*changed, 21, 25);
  EXPECT_EQ(observed(*plain), observed(*changed));
}

TEST_P(PlantFmuTest, ABadParameterIsSaidWhenThePlantIsBuilt) {
  const auto slave = load();
  const double negative = -3;
  slave->set(port("robot.actuators.arm.peak_torque_Nm"), &negative);
  EXPECT_THAT(messageOf([&] { slave->initialize(kSimStart); }),
              HasSubstr("peak_torque_Nm is -3, must be"));
}

// Start values in the model description are what the plant takes when nobody sets them: setting
// each of them to its start value, by force, changes nothing.
TEST_P(PlantFmuTest, StartValuesAreThoseOfTheScenario) {
  ConfigNode spelled_out = testScenario();
  for (const PlantParameter& p : plantParameters())
    setParameter(p, parameterValue(p, testScenario()), spelled_out);
  Plant native(readPlantConfig(testScenario())), same(readPlantConfig(spelled_out));
  for (Plant* plant : {&native, &same}) {
    plant->reset(kSimStart);
    for (int k = 1; k <= 20; ++k) plant->advanceTo(kSimStart + k * kStep, commandOf(k));
  }
  EXPECT_EQ(native.stateDigest(), same.stateDigest());
}

TEST_P(PlantFmuTest, LivesAThousandTimes) {
  for (int i = 0; i < 1000; ++i) {
    const auto slave = load();
    if (i % 100 == 0) {
      slave->initialize(kSimStart);
      run(*slave, 1, 2);
    }
  }
}

// The plant's own reader names all choices when it refuses one: they are those of the parameter.
TEST(PlantParameters, ChoicesAreThoseOfThePlant) {
  for (const PlantParameter& p : plantParameters()) {
    if (p.type != VariableType::kEnumeration) continue;
    std::string choices;
    for (const std::string& c : p.choices) choices += (choices.empty() ? "" : ", ") + c;
    ConfigNode scenario = testScenario();
    applyOverride(scenario, p.path + "=nonsense");
    const std::string words = messageOf([&] { readPlantConfig(scenario); });
    EXPECT_THAT(words, ::testing::EndsWith("must be one of: " + choices)) << p.path;
  }
}

INSTANTIATE_TEST_SUITE_P(Fmi, PlantFmuTest, ::testing::Values(2, 3),
                         [](const auto& version) { return std::to_string(version.param); });

}  // namespace
}  // namespace ballbot
