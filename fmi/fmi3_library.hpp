#pragma once

#include "fmi/fmi3_interface.hpp"
#include "fmi/shared_library.hpp"

namespace ballbot {

/// Every function of the interface, for what is done with all of them.
// clang-format off
#define BALLBOT_FMI3_FUNCTIONS(X) \
  X(fmi3GetVersion) \
  X(fmi3SetDebugLogging) \
  X(fmi3InstantiateModelExchange) \
  X(fmi3InstantiateCoSimulation) \
  X(fmi3InstantiateScheduledExecution) \
  X(fmi3FreeInstance) \
  X(fmi3EnterInitializationMode) \
  X(fmi3ExitInitializationMode) \
  X(fmi3EnterEventMode) \
  X(fmi3Terminate) \
  X(fmi3Reset) \
  X(fmi3GetFloat32) \
  X(fmi3GetFloat64) \
  X(fmi3GetInt8) \
  X(fmi3GetUInt8) \
  X(fmi3GetInt16) \
  X(fmi3GetUInt16) \
  X(fmi3GetInt32) \
  X(fmi3GetUInt32) \
  X(fmi3GetInt64) \
  X(fmi3GetUInt64) \
  X(fmi3GetBoolean) \
  X(fmi3GetString) \
  X(fmi3GetBinary) \
  X(fmi3GetClock) \
  X(fmi3SetFloat32) \
  X(fmi3SetFloat64) \
  X(fmi3SetInt8) \
  X(fmi3SetUInt8) \
  X(fmi3SetInt16) \
  X(fmi3SetUInt16) \
  X(fmi3SetInt32) \
  X(fmi3SetUInt32) \
  X(fmi3SetInt64) \
  X(fmi3SetUInt64) \
  X(fmi3SetBoolean) \
  X(fmi3SetString) \
  X(fmi3SetBinary) \
  X(fmi3SetClock) \
  X(fmi3GetNumberOfVariableDependencies) \
  X(fmi3GetVariableDependencies) \
  X(fmi3GetFMUState) \
  X(fmi3SetFMUState) \
  X(fmi3FreeFMUState) \
  X(fmi3SerializedFMUStateSize) \
  X(fmi3SerializeFMUState) \
  X(fmi3DeserializeFMUState) \
  X(fmi3GetDirectionalDerivative) \
  X(fmi3GetAdjointDerivative) \
  X(fmi3EnterConfigurationMode) \
  X(fmi3ExitConfigurationMode) \
  X(fmi3GetIntervalDecimal) \
  X(fmi3GetIntervalFraction) \
  X(fmi3GetShiftDecimal) \
  X(fmi3GetShiftFraction) \
  X(fmi3SetIntervalDecimal) \
  X(fmi3SetIntervalFraction) \
  X(fmi3SetShiftDecimal) \
  X(fmi3SetShiftFraction) \
  X(fmi3EvaluateDiscreteStates) \
  X(fmi3UpdateDiscreteStates) \
  X(fmi3EnterContinuousTimeMode) \
  X(fmi3CompletedIntegratorStep) \
  X(fmi3SetTime) \
  X(fmi3SetContinuousStates) \
  X(fmi3GetContinuousStateDerivatives) \
  X(fmi3GetEventIndicators) \
  X(fmi3GetContinuousStates) \
  X(fmi3GetNominalsOfContinuousStates) \
  X(fmi3GetNumberOfEventIndicators) \
  X(fmi3GetNumberOfContinuousStates) \
  X(fmi3EnterStepMode) \
  X(fmi3GetOutputDerivatives) \
  X(fmi3DoStep) \
  X(fmi3ActivateModelPartition)
// clang-format on

/// The functions of a loaded FMI 3 FMU, by their names in the standard:
///     Fmi3Library fmu(path);  fmu.fmi3GetVersion();
struct Fmi3Library {
  /// @throw InputError if it cannot be loaded, or lacks what every co-simulation calls. Anything
  ///        else that is missing returns an error when called.
  explicit Fmi3Library(const std::string& path) : library(path) {
#define BALLBOT_FIND(name) name = library.find<decltype(name)>(#name);
    BALLBOT_FMI3_FUNCTIONS(BALLBOT_FIND)
#undef BALLBOT_FIND
    library.require({"fmi3InstantiateCoSimulation", "fmi3FreeInstance",
                     "fmi3EnterInitializationMode", "fmi3ExitInitializationMode", "fmi3DoStep"});
  }

  SharedLibrary library;
#define BALLBOT_POINTER(name) decltype(&::name) name = nullptr;
  BALLBOT_FMI3_FUNCTIONS(BALLBOT_POINTER)
#undef BALLBOT_POINTER
};

}  // namespace ballbot
