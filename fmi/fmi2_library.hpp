#pragma once

#include "fmi/fmi2_interface.hpp"
#include "fmi/shared_library.hpp"

namespace ballbot {

/// Every function of the interface, for what is done with all of them.
// clang-format off
#define BALLBOT_FMI2_FUNCTIONS(X) \
  X(fmi2GetTypesPlatform) \
  X(fmi2GetVersion) \
  X(fmi2SetDebugLogging) \
  X(fmi2Instantiate) \
  X(fmi2FreeInstance) \
  X(fmi2SetupExperiment) \
  X(fmi2EnterInitializationMode) \
  X(fmi2ExitInitializationMode) \
  X(fmi2Terminate) \
  X(fmi2Reset) \
  X(fmi2GetReal) \
  X(fmi2GetInteger) \
  X(fmi2GetBoolean) \
  X(fmi2GetString) \
  X(fmi2SetReal) \
  X(fmi2SetInteger) \
  X(fmi2SetBoolean) \
  X(fmi2SetString) \
  X(fmi2GetFMUstate) \
  X(fmi2SetFMUstate) \
  X(fmi2FreeFMUstate) \
  X(fmi2SerializedFMUstateSize) \
  X(fmi2SerializeFMUstate) \
  X(fmi2DeSerializeFMUstate) \
  X(fmi2GetDirectionalDerivative) \
  X(fmi2SetRealInputDerivatives) \
  X(fmi2GetRealOutputDerivatives) \
  X(fmi2DoStep) \
  X(fmi2CancelStep) \
  X(fmi2GetStatus) \
  X(fmi2GetRealStatus) \
  X(fmi2GetIntegerStatus) \
  X(fmi2GetBooleanStatus) \
  X(fmi2GetStringStatus)
// clang-format on

/// The functions of a loaded FMI 2 FMU, by their names in the standard:
///     Fmi2Library fmu(path);  fmu.fmi2GetVersion();
struct Fmi2Library {
  /// @throw InputError if it cannot be loaded, or lacks what every co-simulation calls. Anything
  ///        else that is missing returns an error when called.
  explicit Fmi2Library(const std::string& path) : library(path) {
#define BALLBOT_FIND(name) name = library.find<decltype(name)>(#name);
    BALLBOT_FMI2_FUNCTIONS(BALLBOT_FIND)
#undef BALLBOT_FIND
    library.require({"fmi2Instantiate", "fmi2FreeInstance", "fmi2SetupExperiment",
                     "fmi2EnterInitializationMode", "fmi2ExitInitializationMode", "fmi2DoStep"});
  }

  SharedLibrary library;
#define BALLBOT_POINTER(name) decltype(&::name) name = nullptr;
  BALLBOT_FMI2_FUNCTIONS(BALLBOT_POINTER)
#undef BALLBOT_POINTER
};

}  // namespace ballbot
