// The C interface of FMI 2, called as an importer calls it.
#include <cmath>
#include <cstdarg>
#include <limits>

#include <fenv.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "fmi/file_uri.hpp"
#include "fmi/fmi2_library.hpp"
#include "tests/fmi/fmu_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// What the logger was told.
struct Told {
  std::vector<std::string> errors, events;
  std::string instance;
};

void tell(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
          fmi2String category, fmi2String format, ...) {
  auto* told = static_cast<Told*>(environment);
  char text[4000];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  told->instance = instance;
  EXPECT_EQ(std::string(category) == "logStatusError", status == fmi2Error);
  (status == fmi2Error ? told->errors : told->events).push_back(text);
}

class Fmi2Test : public ::testing::Test {
 protected:
  ~Fmi2Test() override { fmu.fmi2FreeInstance(c); }

  fmi2Component instantiate(const std::string& name, const std::string& guid,
                            const std::string& location, bool logging = false) {
    const fmi2CallbackFunctions callbacks{tell, nullptr, nullptr, nullptr,
                                          &told};  // gone when this returns
    return fmu.fmi2Instantiate(name.c_str(), fmi2CoSimulation, guid.c_str(), location.c_str(),
                               &callbacks, fmi2False, logging);
  }
  void create(const std::string& name = "one", bool logging = false) {
    c = instantiate(name, guid(), fileUri(unpacked.folder + "/resources"), logging);
    ASSERT_NE(c, nullptr) << lastError();
  }
  void initialize(double start = 0, bool stop_defined = false, double stop = 0) {
    create();
    ASSERT_EQ(fmu.fmi2SetupExperiment(c, fmi2False, 0, start, stop_defined, stop), fmi2OK);
    ASSERT_EQ(fmu.fmi2EnterInitializationMode(c), fmi2OK);
    ASSERT_EQ(fmu.fmi2ExitInitializationMode(c), fmi2OK);
  }
  const std::string& guid() const { return unpacked.description.token; }
  std::string lastError() const { return told.errors.empty() ? "" : told.errors.back(); }
  /// The words with which a call was refused; every error has some.
  std::string words(fmi2Status status) {
    EXPECT_EQ(status, fmi2Error);
    const std::string said = lastError();
    told.errors.clear();
    return said;
  }
  double real(const std::string& name) {
    const fmi2ValueReference vr = unpacked.reference(name);
    double value = kNan;
    EXPECT_EQ(fmu.fmi2GetReal(c, &vr, 1, &value), fmi2OK) << lastError();
    return value;
  }

  const UnpackedFmu& unpacked = unpackedFmu(2);
  Fmi2Library fmu{unpacked.libraryPath()};
  Told told;
  fmi2Component c = nullptr;
};

TEST_F(Fmi2Test, SaysWhatItIs) {
  EXPECT_STREQ(fmu.fmi2GetVersion(), "2.0");
  EXPECT_STREQ(fmu.fmi2GetTypesPlatform(), "default");
}

TEST_F(Fmi2Test, InstantiatesOnlyWhatFits) {
  const std::string resources = unpacked.folder + "/resources", uri = fileUri(resources);
  for (const std::string& place :
       {uri, uri + "/", "file:" + uri.substr(7), "file://localhost" + uri.substr(7), resources}) {
    const fmi2Component good = instantiate("one", guid(), place);
    EXPECT_NE(good, nullptr) << place << ": " << lastError();
    fmu.fmi2FreeInstance(good);
  }
  const auto refusal = [&](fmi2Component instance) {
    EXPECT_EQ(instance, nullptr);
    return told.errors.empty() ? "" : told.errors.back();
  };
  EXPECT_THAT(refusal(instantiate("one", "{00000000-0000-0000-0000-000000000000}", uri)),
              HasSubstr("model description and resources are not of one FMU"));
  EXPECT_THAT(refusal(instantiate(" ", guid(), uri)), HasSubstr("instance name is empty"));
  EXPECT_THAT(refusal(instantiate("one", guid(), "")), HasSubstr("no resource location"));
  EXPECT_THAT(refusal(instantiate("one", guid(), "file:///nowhere")), HasSubstr("cannot be read"));
  EXPECT_THAT(refusal(instantiate("one", guid(), "http://far/away")),
              HasSubstr("neither a file URI nor a path"));
  const fmi2CallbackFunctions callbacks{tell, nullptr, nullptr, nullptr, &told};
  EXPECT_THAT(refusal(fmu.fmi2Instantiate("one", fmi2ModelExchange, guid().c_str(), uri.c_str(),
                                          &callbacks, 0, 0)),
              HasSubstr("Co-Simulation only"));
  EXPECT_EQ(
      fmu.fmi2Instantiate("one", fmi2CoSimulation, guid().c_str(), uri.c_str(), nullptr, 0, 0),
      nullptr);
  EXPECT_THAT(
      refusal(fmu.fmi2Instantiate(nullptr, fmi2CoSimulation, nullptr, nullptr, &callbacks, 0, 0)),
      HasSubstr("instance name"));
}

TEST_F(Fmi2Test, LogsUntrustedTextAsTextAndKeepsTheInstanceName) {
  create("100 %s %n of #1#", true);
  EXPECT_THAT(words(fmu.fmi2DoStep(c, 0, 0.01, fmi2False)),
              HasSubstr("not allowed in state 'instantiated'"));
  EXPECT_EQ(told.instance, "100 %s %n of #1#");
  const char* category = "%n%s #";
  EXPECT_THAT(words(fmu.fmi2SetDebugLogging(c, fmi2True, 1, &category)),
              HasSubstr("no log category '%n%s ##'"));
}

TEST_F(Fmi2Test, LogsEventsOnlyWhereAsked) {
  initialize();
  EXPECT_THAT(told.events, IsEmpty());
  const char* category = "logEvents";
  EXPECT_EQ(fmu.fmi2SetDebugLogging(c, fmi2True, 1, &category), fmi2OK);
  EXPECT_EQ(fmu.fmi2Terminate(c), fmi2OK);
  ASSERT_EQ(told.events.size(), 1U);
  EXPECT_THAT(told.events[0], HasSubstr("terminated at 0"));
}

TEST_F(Fmi2Test, CallsOutOfOrderAreErrorsInWords) {
  create();
  EXPECT_THAT(words(fmu.fmi2ExitInitializationMode(c)),
              HasSubstr("leaving initialization is not allowed in state 'instantiated'"));
  // An error is left by reset.
  EXPECT_THAT(words(fmu.fmi2EnterInitializationMode(c)), HasSubstr("in state 'failed'"));
  ASSERT_EQ(fmu.fmi2Reset(c), fmi2OK);
  ASSERT_EQ(fmu.fmi2SetupExperiment(c, 0, 0, 0, 0, 0), fmi2OK);
  ASSERT_EQ(fmu.fmi2EnterInitializationMode(c), fmi2OK);
  ASSERT_EQ(fmu.fmi2ExitInitializationMode(c), fmi2OK);
  EXPECT_THAT(words(fmu.fmi2SetupExperiment(c, 0, 0, 0, 0, 0)),
              HasSubstr("not allowed in state 'step'"));
  EXPECT_EQ(fmu.fmi2DoStep(nullptr, 0, 0.01, fmi2False), fmi2Error);
  fmu.fmi2FreeInstance(nullptr);
}

TEST_F(Fmi2Test, EveryVariableCanBeReadInInitializationAfterItAndWhenTerminated) {
  create();
  const auto readAll = [&] {
    for (const ImportedVariable& v : unpacked.description.variables) {
      double number = 0;
      int whole = 0;
      const fmi2Status status = v.type == "Real" ? fmu.fmi2GetReal(c, &v.reference, 1, &number)
                                : v.type == "Boolean"
                                    ? fmu.fmi2GetBoolean(c, &v.reference, 1, &whole)
                                    : fmu.fmi2GetInteger(c, &v.reference, 1, &whole);
      ASSERT_EQ(status, fmi2OK) << v.name << ": " << lastError();
    }
  };
  ASSERT_EQ(fmu.fmi2EnterInitializationMode(c), fmi2OK);
  readAll();
  ASSERT_EQ(fmu.fmi2ExitInitializationMode(c), fmi2OK);
  readAll();
  EXPECT_NEAR(real("sensors.accel_B[3]"), 9.8, 0.1);
  ASSERT_EQ(fmu.fmi2Terminate(c), fmi2OK);
  readAll();
}

TEST_F(Fmi2Test, WrongReferencesTypesAndValuesAreErrors) {
  initialize();
  double number = 1;
  int whole = 1;
  const char* text = "";
  const auto at = [&](const char* name) { return unpacked.reference(name); };
  const fmi2ValueReference none = 1'000'000, torque = at("command.torque[1]"),
                           angle = at("sensors.joint_angle[1]"), count = at("sensors.imu_count"),
                           seed = at("seed");
  const auto again = [&] {
    fmu.fmi2FreeInstance(c);
    initialize();
  };
  EXPECT_THAT(words(fmu.fmi2GetReal(c, &none, 1, &number)),
              HasSubstr("no variable with value reference 1000000"));
  again();
  EXPECT_THAT(words(fmu.fmi2GetReal(c, &count, 1, &number)),
              HasSubstr("'sensors.imu_count' (value reference"));
  again();
  EXPECT_THAT(words(fmu.fmi2GetInteger(c, &angle, 1, &whole)), HasSubstr("is no Integer"));
  again();
  EXPECT_THAT(words(fmu.fmi2SetReal(c, &angle, 1, &number)),
              HasSubstr("is no input and no parameter"));
  again();
  EXPECT_THAT(words(fmu.fmi2SetInteger(c, &seed, 1, &whole)),
              HasSubstr("only before initialization ends"));
  again();
  EXPECT_THAT(words(fmu.fmi2GetString(c, &torque, 1, &text)), HasSubstr("no String variables"));
  again();
  EXPECT_THAT(words(fmu.fmi2GetReal(c, nullptr, 1, &number)), HasSubstr("vr is a null pointer"));
  again();
  EXPECT_THAT(words(fmu.fmi2SetReal(c, &torque, 1, nullptr)), HasSubstr("value is a null pointer"));
  again();
  EXPECT_EQ(fmu.fmi2GetReal(c, nullptr, 0, nullptr), fmi2OK);
  EXPECT_EQ(fmu.fmi2SetString(c, nullptr, 0, nullptr), fmi2OK);
  for (const double bad : {kNan, HUGE_VAL, -HUGE_VAL}) {
    EXPECT_THAT(words(fmu.fmi2SetReal(c, &torque, 1, &bad)),
                HasSubstr("'command.torque[1]' is set to"));
    again();
  }
}

TEST_F(Fmi2Test, StepsThatAreNoneAreErrorsAndChangeNothing) {
  initialize(0, true, 0.1);
  ASSERT_EQ(fmu.fmi2DoStep(c, 0, 0.01, fmi2True), fmi2OK);
  fmi2FMUstate state = nullptr;
  ASSERT_EQ(fmu.fmi2GetFMUstate(c, &state), fmi2OK);
  const std::pair<double, double> steps[] = {{0.01, kNan},     {0.01, 0},     {0.01, -0.01},
                                             {0.01, HUGE_VAL}, {kNan, 0.01},  {0, 0.01},
                                             {0.02, 0.01},     {0.01, 1e-12}, {0.01, 1}};
  for (const auto& [point, step] : steps) {
    const double angle = real("truth.motor_angle[1]");
    EXPECT_THAT(words(fmu.fmi2DoStep(c, point, step, fmi2True)), HasSubstr("fmi2DoStep: doStep: "))
        << point << " " << step;
    EXPECT_EQ(real("time"), 0.01);
    EXPECT_EQ(real("truth.motor_angle[1]"), angle);
    ASSERT_EQ(fmu.fmi2SetFMUstate(c, state), fmi2OK);
  }
  EXPECT_EQ(fmu.fmi2DoStep(c, 0.01, 0.009999999999999998, fmi2True), fmi2OK);
  EXPECT_EQ(real("time"), 0.02);
}

TEST_F(Fmi2Test, StartsWhereItIsTold) {
  initialize(3.5);
  EXPECT_EQ(real("time"), 3.5);
  EXPECT_EQ(fmu.fmi2DoStep(c, 3.5, 0.01, fmi2True), fmi2OK);
  EXPECT_EQ(real("sensors.imu_time"), 3.51);
  fmu.fmi2FreeInstance(c);
  create();
  EXPECT_THAT(words(fmu.fmi2SetupExperiment(c, 0, 0, kNan, 0, 0)), HasSubstr("start time is nan"));
}

TEST_F(Fmi2Test, WhatItDoesNotOfferItSays) {
  initialize();
  const fmi2ValueReference vr = unpacked.reference("sensors.joint_angle[1]");
  const int order = 1;
  double number = 0;
  int whole = 0;
  fmi2Status status = fmi2Error;
  const char* text = nullptr;
  EXPECT_EQ(fmu.fmi2GetStatus(c, fmi2DoStepStatus, &status), fmi2OK);
  EXPECT_EQ(status, fmi2OK);
  EXPECT_EQ(fmu.fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &number), fmi2OK);
  EXPECT_EQ(fmu.fmi2GetBooleanStatus(c, fmi2Terminated, &whole), fmi2OK);
  EXPECT_EQ(fmu.fmi2GetStringStatus(c, fmi2PendingStatus, &text), fmi2OK);
  EXPECT_STREQ(text, "");
  EXPECT_THAT(words(fmu.fmi2GetIntegerStatus(c, fmi2DoStepStatus, &whole)),
              HasSubstr("no status is an Integer"));
  EXPECT_THAT(words(fmu.fmi2CancelStep(c)), HasSubstr("no step is in progress"));
  EXPECT_THAT(words(fmu.fmi2GetDirectionalDerivative(c, &vr, 1, &vr, 1, &number, &number)),
              HasSubstr("not provided"));
  EXPECT_THAT(words(fmu.fmi2SetRealInputDerivatives(c, &vr, 1, &order, &number)),
              HasSubstr("canInterpolateInputs=false"));
  EXPECT_THAT(words(fmu.fmi2GetRealOutputDerivatives(c, &vr, 1, &order, &number)),
              HasSubstr("maxOutputDerivativeOrder=0"));
}

/// The process's environment variables, as they are now.
std::vector<std::string> environmentNow() {
  std::vector<std::string> out;
  for (char** v = ::environ; *v; ++v) out.push_back(*v);
  return out;
}

TEST_F(Fmi2Test, LeavesEnvironmentFloatingPointModeOutputAndFolderAlone) {
  const std::vector<std::string> environment = environmentNow();
  char before[4096], after[4096];
  ASSERT_NE(::getcwd(before, sizeof before), nullptr);
  std::fesetround(FE_UPWARD);  // somebody's odd wish
  std::feclearexcept(FE_ALL_EXCEPT);
  ::testing::internal::CaptureStdout();
  initialize();
  for (int k = 0; k < 5; ++k) ASSERT_EQ(fmu.fmi2DoStep(c, 0.01 * k, 0.01, fmi2True), fmi2OK);
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
  EXPECT_EQ(::fegetexcept(), 0);  // traps
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  ASSERT_NE(::getcwd(after, sizeof after), nullptr);
  EXPECT_STREQ(before, after);
  EXPECT_EQ(environmentNow(), environment);
}

TEST_F(Fmi2Test, LoggingChangesNoBit) {
  std::vector<std::string> states;
  for (const bool logging : {false, true}) {
    create("one", logging);
    ASSERT_EQ(fmu.fmi2EnterInitializationMode(c), fmi2OK);
    ASSERT_EQ(fmu.fmi2ExitInitializationMode(c), fmi2OK);
    for (int k = 0; k < 10; ++k) ASSERT_EQ(fmu.fmi2DoStep(c, 0.01 * k, 0.01, fmi2True), fmi2OK);
    fmi2FMUstate state = nullptr;
    std::size_t size = 0;
    ASSERT_EQ(fmu.fmi2GetFMUstate(c, &state), fmi2OK);
    ASSERT_EQ(fmu.fmi2SerializedFMUstateSize(c, state, &size), fmi2OK);
    states.emplace_back(size, '\0');
    ASSERT_EQ(fmu.fmi2SerializeFMUstate(c, state, states.back().data(), size), fmi2OK);
    fmu.fmi2FreeInstance(c);
    c = nullptr;
  }
  EXPECT_FALSE(told.events.empty());
  EXPECT_TRUE(states[0] == states[1]);
}

}  // namespace
}  // namespace ballbot
