// The C interface of FMI 3, called as an importer calls it, where it differs from FMI 2.
#include <limits>

#include <gmock/gmock.h>

#include "fmi/fmi3_library.hpp"
#include "tests/fmi/fmu_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

void tell(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String, fmi3String message) {
  if (status == fmi3Error) static_cast<std::vector<std::string>*>(environment)->push_back(message);
}

class Fmi3Test : public ::testing::Test {
 protected:
  ~Fmi3Test() override { fmu.fmi3FreeInstance(i); }

  fmi3Instance instantiate(const char* name, const char* token, const char* resources,
                           bool logging = true, bool event_mode = false) {
    return fmu.fmi3InstantiateCoSimulation(name, token, resources, false, logging, event_mode,
                                           false, nullptr, 0, &errors, tell, nullptr);
  }
  void create(bool logging = true) {
    i = instantiate("one", token(), (unpacked.folder + "/resources/").c_str(), logging);
    ASSERT_NE(i, nullptr) << said();
  }
  void initialize() {
    create();
    ASSERT_EQ(fmu.fmi3EnterInitializationMode(i, false, 0, 0, true, 1), fmi3OK);
    ASSERT_EQ(fmu.fmi3ExitInitializationMode(i), fmi3OK);
  }
  const char* token() const { return unpacked.description.token.c_str(); }
  std::string said() const { return errors.empty() ? "" : errors.back(); }
  std::string words(fmi3Status status) {
    EXPECT_EQ(status, fmi3Error);
    const std::string text = said();
    errors.clear();
    return text;
  }
  fmi3ValueReference at(const char* name) const { return unpacked.reference(name); }

  const UnpackedFmu& unpacked = unpackedFmu(3);
  Fmi3Library fmu{unpacked.libraryPath()};
  std::vector<std::string> errors;
  fmi3Instance i = nullptr;
};

TEST_F(Fmi3Test, ArraysGoInOneCallAndSeveralVariablesToo) {
  initialize();
  const fmi3ValueReference command[] = {at("command.torque"), at("command.stiffness")};
  double values[12];
  for (int k = 0; k < 12; ++k) values[k] = 0.1 * k;
  ASSERT_EQ(fmu.fmi3SetFloat64(i, command, 2, values, 12), fmi3OK) << said();
  double read[12] = {};
  ASSERT_EQ(fmu.fmi3GetFloat64(i, command, 2, read, 12), fmi3OK);
  for (int k = 0; k < 12; ++k) EXPECT_EQ(read[k], values[k]);
  EXPECT_THAT(words(fmu.fmi3GetFloat64(i, command, 2, read, 11)),
              HasSubstr("nValues is 11, but the 2 variables have 12"));
}

TEST_F(Fmi3Test, ElementsOfArraysHaveNoReferenceOfTheirOwn) {
  initialize();
  const fmi3ValueReference second = at("command.torque") + 1;
  double value = 0;
  EXPECT_THAT(words(fmu.fmi3GetFloat64(i, &second, 1, &value, 1)),
              HasSubstr("there is no variable with value reference"));
}

TEST_F(Fmi3Test, CountsAndChoicesAreInt64AndFlagsBoolean) {
  create();
  const fmi3ValueReference actuators = at("plant.fidelity.actuators"),
                           friction = at("plant.fidelity.friction");
  std::int64_t level = 0;
  bool flag = false;
  ASSERT_EQ(fmu.fmi3GetInt64(i, &actuators, 1, &level, 1), fmi3OK) << said();
  EXPECT_EQ(level, 2) << "series_elastic";
  ASSERT_EQ(fmu.fmi3GetBoolean(i, &friction, 1, &flag, 1), fmi3OK);
  EXPECT_TRUE(flag);
  level = 3;
  EXPECT_THAT(words(fmu.fmi3SetInt64(i, &actuators, 1, &level, 1)),
              HasSubstr("plant.fidelity.actuators is 3, must be 1 to 2"));
}

TEST_F(Fmi3Test, DoStepTellsWhereItStands) {
  initialize();
  bool event = true, end = true, early = true;
  double reached = -1;
  ASSERT_EQ(fmu.fmi3DoStep(i, 0, 0.0025, true, &event, &end, &early, &reached), fmi3OK) << said();
  EXPECT_FALSE(event || end || early);
  EXPECT_EQ(reached, 0.0025);
  EXPECT_THAT(words(fmu.fmi3DoStep(i, 0.0025, std::numeric_limits<double>::quiet_NaN(), true,
                                   &event, &end, &early, &reached)),
              HasSubstr("step size is nan"));
  EXPECT_EQ(reached, 0.0025);
  EXPECT_THAT(words(fmu.fmi3DoStep(i, 0.0025, 0.0025, true, nullptr, nullptr, nullptr, nullptr)),
              HasSubstr("not allowed in state 'failed'"));
}

TEST_F(Fmi3Test, StopTimeHolds) {
  initialize();
  EXPECT_THAT(words(fmu.fmi3DoStep(i, 0, 1.01, true, nullptr, nullptr, nullptr, nullptr)),
              HasSubstr("past the stop time"));
}

TEST_F(Fmi3Test, InstantiatesCoSimulationWithoutEventsOnly) {
  const std::string resources = unpacked.folder + "/resources/";
  EXPECT_EQ(instantiate("one", token(), resources.c_str(), true, true), nullptr);
  EXPECT_THAT(said(), HasSubstr("hasEventMode=false"));
  EXPECT_EQ(instantiate("one", "wrong", resources.c_str()), nullptr);
  EXPECT_THAT(said(), HasSubstr("are not of one FMU"));
  EXPECT_EQ(instantiate("one", token(), nullptr), nullptr);
  EXPECT_THAT(said(), HasSubstr("no resource location"));
  EXPECT_EQ(fmu.fmi3InstantiateModelExchange("one", token(), resources.c_str(), false, true,
                                             &errors, tell),
            nullptr);
  EXPECT_THAT(said(), HasSubstr("Co-Simulation only"));
  EXPECT_EQ(fmu.fmi3InstantiateScheduledExecution("one", token(), resources.c_str(), false, true,
                                                  &errors, tell, nullptr, nullptr, nullptr),
            nullptr);
  EXPECT_THAT(said(), HasSubstr("Co-Simulation only"));
}

TEST_F(Fmi3Test, IsSilentWhenToldTo) {
  create(false);
  EXPECT_EQ(fmu.fmi3Terminate(i), fmi3Error);
  EXPECT_THAT(errors, IsEmpty());
}

// Functions of what this FMU does not offer: an error in words, never a crash, whatever is passed.
TEST_F(Fmi3Test, WhatItDoesNotOfferItSays) {
  initialize();
  const auto clocks = HasSubstr("no clocks");
  EXPECT_THAT(words(fmu.fmi3EnterEventMode(i)), HasSubstr("hasEventMode=false"));
  EXPECT_THAT(words(fmu.fmi3EnterStepMode(i)), HasSubstr("hasEventMode=false"));
  EXPECT_THAT(
      words(fmu.fmi3UpdateDiscreteStates(i, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr)),
      HasSubstr("hasEventMode=false"));
  EXPECT_THAT(words(fmu.fmi3EvaluateDiscreteStates(i)), HasSubstr("hasEventMode=false"));
  EXPECT_THAT(words(fmu.fmi3EnterConfigurationMode(i)), HasSubstr("no structural parameters"));
  EXPECT_THAT(words(fmu.fmi3ExitConfigurationMode(i)), HasSubstr("no structural parameters"));
  EXPECT_THAT(words(fmu.fmi3GetIntervalDecimal(i, nullptr, 0, nullptr, nullptr)), clocks);
  EXPECT_THAT(words(fmu.fmi3GetIntervalFraction(i, nullptr, 0, nullptr, nullptr, nullptr)), clocks);
  EXPECT_THAT(words(fmu.fmi3GetShiftDecimal(i, nullptr, 0, nullptr)), clocks);
  EXPECT_THAT(words(fmu.fmi3GetShiftFraction(i, nullptr, 0, nullptr, nullptr)), clocks);
  EXPECT_THAT(words(fmu.fmi3SetIntervalDecimal(i, nullptr, 0, nullptr)), clocks);
  EXPECT_THAT(words(fmu.fmi3SetIntervalFraction(i, nullptr, 0, nullptr, nullptr)), clocks);
  EXPECT_THAT(words(fmu.fmi3SetShiftDecimal(i, nullptr, 0, nullptr)), clocks);
  EXPECT_THAT(words(fmu.fmi3SetShiftFraction(i, nullptr, 0, nullptr, nullptr)), clocks);
  const auto only = HasSubstr("Co-Simulation only");
  EXPECT_THAT(words(fmu.fmi3EnterContinuousTimeMode(i)), only);
  EXPECT_THAT(words(fmu.fmi3CompletedIntegratorStep(i, false, nullptr, nullptr)), only);
  EXPECT_THAT(words(fmu.fmi3SetTime(i, 0)), only);
  EXPECT_THAT(words(fmu.fmi3SetContinuousStates(i, nullptr, 0)), only);
  EXPECT_THAT(words(fmu.fmi3GetContinuousStates(i, nullptr, 0)), only);
  EXPECT_THAT(words(fmu.fmi3GetContinuousStateDerivatives(i, nullptr, 0)), only);
  EXPECT_THAT(words(fmu.fmi3GetNominalsOfContinuousStates(i, nullptr, 0)), only);
  EXPECT_THAT(words(fmu.fmi3GetEventIndicators(i, nullptr, 0)), only);
  EXPECT_THAT(words(fmu.fmi3GetNumberOfContinuousStates(i, nullptr)), only);
  EXPECT_THAT(words(fmu.fmi3GetNumberOfEventIndicators(i, nullptr)), only);
  EXPECT_THAT(words(fmu.fmi3ActivateModelPartition(i, 0, 0)), only);
  EXPECT_THAT(words(fmu.fmi3GetOutputDerivatives(i, nullptr, 0, nullptr, nullptr, 0)),
              HasSubstr("maxOutputDerivativeOrder=0"));
  EXPECT_THAT(
      words(fmu.fmi3GetDirectionalDerivative(i, nullptr, 0, nullptr, 0, nullptr, 0, nullptr, 0)),
      HasSubstr("not provided"));
  EXPECT_THAT(
      words(fmu.fmi3GetAdjointDerivative(i, nullptr, 0, nullptr, 0, nullptr, 0, nullptr, 0)),
      HasSubstr("not provided"));
  EXPECT_THAT(words(fmu.fmi3GetNumberOfVariableDependencies(i, 0, nullptr)),
              HasSubstr("not provided"));
  EXPECT_THAT(words(fmu.fmi3GetVariableDependencies(i, 0, nullptr, nullptr, nullptr, nullptr, 0)),
              HasSubstr("not provided"));
}

TEST_F(Fmi3Test, TypesThatNoVariableHasTakeEmptyRequestsOnly) {
  initialize();
  EXPECT_EQ(fmu.fmi3GetFloat32(i, nullptr, 0, nullptr, 0), fmi3OK);
  EXPECT_EQ(fmu.fmi3SetBinary(i, nullptr, 0, nullptr, nullptr, 0), fmi3OK);
  EXPECT_EQ(fmu.fmi3GetClock(i, nullptr, 0, nullptr), fmi3OK);
  const fmi3ValueReference vr = 0;
  fmi3UInt8 byte = 0;
  EXPECT_THAT(words(fmu.fmi3GetUInt8(i, &vr, 1, &byte, 1)), HasSubstr("no variables of this type"));
  const char* text = "";
  EXPECT_THAT(words(fmu.fmi3SetString(i, &vr, 1, &text, 1)),
              HasSubstr("no variables of this type"));
}

}  // namespace
}  // namespace ballbot
