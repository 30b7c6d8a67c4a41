// The plant as an FMI 3.0 Co-Simulation FMU: the 75 functions of the standard over PlantFmu.
#include <cmath>
#include <cstring>
#include <string>

#include "core/error.hpp"
#include "fmi/file_uri.hpp"
#include "fmi/fmi3_calls.hpp"
#include "fmi/step_time.hpp"

using namespace ballbot;

extern "C" {

const char* fmi3GetVersion() { return "3.0"; }

fmi3Status fmi3SetDebugLogging(fmi3Instance i, fmi3Boolean on, std::size_t count,
                               const fmi3String categories[]) {
  return attempt(i, "fmi3SetDebugLogging",
                 [&](FmuInstance& f) { f.setLogging(on, count, categories); });
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                          fmi3Boolean, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
  return refuse(environment, log,
                "fmi3InstantiateModelExchange: this FMU is for Co-Simulation only");
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                               fmi3Boolean, fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback log, fmi3ClockUpdateCallback,
                                               fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback) {
  return refuse(environment, log,
                "fmi3InstantiateScheduledExecution: this FMU is for Co-Simulation only");
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resource_path, fmi3Boolean /*visible*/,
    fmi3Boolean logging_on, fmi3Boolean event_mode_used, fmi3Boolean /*early_return_allowed*/,
    const fmi3ValueReference[], std::size_t required_intermediate_variable_count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3IntermediateUpdateCallback) {
  try {
    if (!name || std::string(name).find_first_not_of(" \t\r\n") == std::string::npos) {
      throw InputError("the instance name is empty");
    }
    if (!token) throw InputError("the instantiation token is missing");
    if (event_mode_used) throw InputError(kNoEvents);
    if (required_intermediate_variable_count > 0) {
      throw InputError("no intermediate update, as providesIntermediateUpdate=false says");
    }
    auto instance = std::make_unique<FmuInstance>(
        resourcePath(resource_path), token, 3,
        [environment, log](const char* category, const std::string& text) {
          if (log)
            log(environment, std::strcmp(category, kLogErrors) == 0 ? fmi3Error : fmi3OK, category,
                text.c_str());
        });
    instance->setLogging(logging_on, 0, nullptr);
    return instance.release();
  } catch (const std::exception& e) {
    try {
      return refuse(environment, log,
                    (std::string("fmi3InstantiateCoSimulation: ") + e.what()).c_str());
    } catch (...) {
    }
  } catch (...) {
  }
  return nullptr;
}

void fmi3FreeInstance(fmi3Instance i) { delete instanceOf(i); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance i, fmi3Boolean, fmi3Float64,
                                       fmi3Float64 start_time, fmi3Boolean stop_time_defined,
                                       fmi3Float64 stop_time) {
  return attempt(i, "fmi3EnterInitializationMode", [&](FmuInstance& f) {
    f.fmu.setTimes(start_time, stop_time_defined ? std::optional<double>(stop_time) : std::nullopt);
    f.fmu.enterInitialization();
  });
}
fmi3Status fmi3ExitInitializationMode(fmi3Instance i) {
  return attempt(i, "fmi3ExitInitializationMode", [](FmuInstance& f) {
    f.fmu.exitInitialization();
    f.note("initialized at " + toText(f.fmu.now()));
  });
}
fmi3Status fmi3EnterEventMode(fmi3Instance i) {
  return unsupported(i, "fmi3EnterEventMode", kNoEvents);
}
fmi3Status fmi3Terminate(fmi3Instance i) {
  return attempt(i, "fmi3Terminate", [](FmuInstance& f) {
    f.fmu.terminate();
    f.note("terminated at " + toText(f.fmu.now()));
  });
}
fmi3Status fmi3Reset(fmi3Instance i) {
  return attempt(i, "fmi3Reset", [](FmuInstance& f) { f.fmu.reset(); });
}

fmi3Status fmi3GetFloat64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                          fmi3Float64 v[], std::size_t count) {
  return get(i, "fmi3GetFloat64", VariableType::kReal, vr, n, v, count);
}
fmi3Status fmi3GetInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n, fmi3Int64 v[],
                        std::size_t count) {
  return get(i, "fmi3GetInt64", VariableType::kInteger, vr, n, v, count);
}
fmi3Status fmi3GetBoolean(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                          fmi3Boolean v[], std::size_t count) {
  return get(i, "fmi3GetBoolean", VariableType::kBoolean, vr, n, v, count);
}
fmi3Status fmi3SetFloat64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                          const fmi3Float64 v[], std::size_t count) {
  return set(i, "fmi3SetFloat64", VariableType::kReal, vr, n, v, count);
}
fmi3Status fmi3SetInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                        const fmi3Int64 v[], std::size_t count) {
  return set(i, "fmi3SetInt64", VariableType::kInteger, vr, n, v, count);
}
fmi3Status fmi3SetBoolean(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                          const fmi3Boolean v[], std::size_t count) {
  return set(i, "fmi3SetBoolean", VariableType::kBoolean, vr, n, v, count);
}

// Types that no variable has.
#define BALLBOT_NO_VARIABLES(Type)                                                    \
  fmi3Status fmi3Get##Type(fmi3Instance i, const fmi3ValueReference[], std::size_t n, \
                           fmi3##Type[], std::size_t) {                               \
    return none(i, "fmi3Get" #Type, n);                                               \
  }                                                                                   \
  fmi3Status fmi3Set##Type(fmi3Instance i, const fmi3ValueReference[], std::size_t n, \
                           const fmi3##Type[], std::size_t) {                         \
    return none(i, "fmi3Set" #Type, n);                                               \
  }
BALLBOT_NO_VARIABLES(Float32)
BALLBOT_NO_VARIABLES(Int8)
BALLBOT_NO_VARIABLES(UInt8)
BALLBOT_NO_VARIABLES(Int16)
BALLBOT_NO_VARIABLES(UInt16)
BALLBOT_NO_VARIABLES(Int32)
BALLBOT_NO_VARIABLES(UInt32)
BALLBOT_NO_VARIABLES(UInt64)
BALLBOT_NO_VARIABLES(String)
#undef BALLBOT_NO_VARIABLES

fmi3Status fmi3GetBinary(fmi3Instance i, const fmi3ValueReference[], std::size_t n, std::size_t[],
                         fmi3Binary[], std::size_t) {
  return none(i, "fmi3GetBinary", n);
}
fmi3Status fmi3SetBinary(fmi3Instance i, const fmi3ValueReference[], std::size_t n,
                         const std::size_t[], const fmi3Binary[], std::size_t) {
  return none(i, "fmi3SetBinary", n);
}
fmi3Status fmi3GetClock(fmi3Instance i, const fmi3ValueReference[], std::size_t n, fmi3Clock[]) {
  return none(i, "fmi3GetClock", n);
}
fmi3Status fmi3SetClock(fmi3Instance i, const fmi3ValueReference[], std::size_t n,
                        const fmi3Clock[]) {
  return none(i, "fmi3SetClock", n);
}
fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance i, fmi3ValueReference, std::size_t*) {
  return unsupported(i, "fmi3GetNumberOfVariableDependencies",
                     "not provided, as providesPerElementDependencies=false says");
}
fmi3Status fmi3GetVariableDependencies(fmi3Instance i, fmi3ValueReference, std::size_t[],
                                       fmi3ValueReference[], std::size_t[], fmi3DependencyKind[],
                                       std::size_t) {
  return unsupported(i, "fmi3GetVariableDependencies",
                     "not provided, as providesPerElementDependencies=false says");
}

fmi3Status fmi3GetFMUState(fmi3Instance i, fmi3FMUState* state) {
  return attempt(i, "fmi3GetFMUState", [&](FmuInstance& f) { f.getState(state); });
}
fmi3Status fmi3SetFMUState(fmi3Instance i, fmi3FMUState state) {
  return attempt(i, "fmi3SetFMUState", [&](FmuInstance& f) { f.setState(state); });
}
fmi3Status fmi3FreeFMUState(fmi3Instance i, fmi3FMUState* state) {
  return attempt(i, "fmi3FreeFMUState", [&](FmuInstance& f) { f.freeState(state); });
}
fmi3Status fmi3SerializedFMUStateSize(fmi3Instance i, fmi3FMUState state, std::size_t* size) {
  return attempt(i, "fmi3SerializedFMUStateSize", [&](FmuInstance& f) {
    require(size, "size");
    *size = f.stateSize(state);
  });
}
fmi3Status fmi3SerializeFMUState(fmi3Instance i, fmi3FMUState state, fmi3Byte bytes[],
                                 std::size_t size) {
  return attempt(i, "fmi3SerializeFMUState",
                 [&](FmuInstance& f) { f.serialize(state, bytes, size); });
}
fmi3Status fmi3DeserializeFMUState(fmi3Instance i, const fmi3Byte bytes[], std::size_t size,
                                   fmi3FMUState* state) {
  return attempt(i, "fmi3DeserializeFMUState",
                 [&](FmuInstance& f) { f.deserialize(bytes, size, state); });
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                        const fmi3ValueReference[], std::size_t,
                                        const fmi3Float64[], std::size_t, fmi3Float64[],
                                        std::size_t) {
  return unsupported(i, "fmi3GetDirectionalDerivative",
                     "not provided, as providesDirectionalDerivatives=false says");
}
fmi3Status fmi3GetAdjointDerivative(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                    const fmi3ValueReference[], std::size_t, const fmi3Float64[],
                                    std::size_t, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetAdjointDerivative",
                     "not provided, as providesAdjointDerivatives=false says");
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance i) {
  return unsupported(i, "fmi3EnterConfigurationMode", kNoStructure);
}
fmi3Status fmi3ExitConfigurationMode(fmi3Instance i) {
  return unsupported(i, "fmi3ExitConfigurationMode", kNoStructure);
}
fmi3Status fmi3GetIntervalDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                  fmi3Float64[], fmi3IntervalQualifier[]) {
  return unsupported(i, "fmi3GetIntervalDecimal", kNoClocks);
}
fmi3Status fmi3GetIntervalFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                   fmi3UInt64[], fmi3UInt64[], fmi3IntervalQualifier[]) {
  return unsupported(i, "fmi3GetIntervalFraction", kNoClocks);
}
fmi3Status fmi3GetShiftDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                               fmi3Float64[]) {
  return unsupported(i, "fmi3GetShiftDecimal", kNoClocks);
}
fmi3Status fmi3GetShiftFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                fmi3UInt64[], fmi3UInt64[]) {
  return unsupported(i, "fmi3GetShiftFraction", kNoClocks);
}
fmi3Status fmi3SetIntervalDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                  const fmi3Float64[]) {
  return unsupported(i, "fmi3SetIntervalDecimal", kNoClocks);
}
fmi3Status fmi3SetIntervalFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                   const fmi3UInt64[], const fmi3UInt64[]) {
  return unsupported(i, "fmi3SetIntervalFraction", kNoClocks);
}
fmi3Status fmi3SetShiftDecimal(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                               const fmi3Float64[]) {
  return unsupported(i, "fmi3SetShiftDecimal", kNoClocks);
}
fmi3Status fmi3SetShiftFraction(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                const fmi3UInt64[], const fmi3UInt64[]) {
  return unsupported(i, "fmi3SetShiftFraction", kNoClocks);
}
fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance i) {
  return unsupported(i, "fmi3EvaluateDiscreteStates", kNoEvents);
}
fmi3Status fmi3UpdateDiscreteStates(fmi3Instance i, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                                    fmi3Boolean*, fmi3Boolean*, fmi3Float64*) {
  return unsupported(i, "fmi3UpdateDiscreteStates", kNoEvents);
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance i) {
  return unsupported(i, "fmi3EnterContinuousTimeMode", kCoSimulationOnly);
}
fmi3Status fmi3CompletedIntegratorStep(fmi3Instance i, fmi3Boolean, fmi3Boolean*, fmi3Boolean*) {
  return unsupported(i, "fmi3CompletedIntegratorStep", kCoSimulationOnly);
}
fmi3Status fmi3SetTime(fmi3Instance i, fmi3Float64) {
  return unsupported(i, "fmi3SetTime", kCoSimulationOnly);
}
fmi3Status fmi3SetContinuousStates(fmi3Instance i, const fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3SetContinuousStates", kCoSimulationOnly);
}
fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance i, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetContinuousStateDerivatives", kCoSimulationOnly);
}
fmi3Status fmi3GetEventIndicators(fmi3Instance i, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetEventIndicators", kCoSimulationOnly);
}
fmi3Status fmi3GetContinuousStates(fmi3Instance i, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetContinuousStates", kCoSimulationOnly);
}
fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance i, fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetNominalsOfContinuousStates", kCoSimulationOnly);
}
fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance i, std::size_t*) {
  return unsupported(i, "fmi3GetNumberOfEventIndicators", kCoSimulationOnly);
}
fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance i, std::size_t*) {
  return unsupported(i, "fmi3GetNumberOfContinuousStates", kCoSimulationOnly);
}

fmi3Status fmi3EnterStepMode(fmi3Instance i) {
  return unsupported(i, "fmi3EnterStepMode", kNoEvents);
}
fmi3Status fmi3GetOutputDerivatives(fmi3Instance i, const fmi3ValueReference[], std::size_t,
                                    const fmi3Int32[], fmi3Float64[], std::size_t) {
  return unsupported(i, "fmi3GetOutputDerivatives",
                     "not provided, as maxOutputDerivativeOrder=0 says");
}
fmi3Status fmi3DoStep(fmi3Instance i, fmi3Float64 communication_point, fmi3Float64 step_size,
                      fmi3Boolean /*no_set_state_prior_to_current_point*/,
                      fmi3Boolean* event_handling_needed, fmi3Boolean* terminate_simulation,
                      fmi3Boolean* early_return, fmi3Float64* last_successful_time) {
  if (event_handling_needed) *event_handling_needed = false;
  if (terminate_simulation) *terminate_simulation = false;
  if (early_return) *early_return = false;
  const fmi3Status status = attempt(
      i, "fmi3DoStep", [&](FmuInstance& f) { f.fmu.doStep(communication_point, step_size); });
  if (i && last_successful_time) *last_successful_time = secondsOf(instanceOf(i)->fmu.now());
  return status;
}
fmi3Status fmi3ActivateModelPartition(fmi3Instance i, fmi3ValueReference, fmi3Float64) {
  return unsupported(i, "fmi3ActivateModelPartition", kCoSimulationOnly);
}

}  // extern "C"
