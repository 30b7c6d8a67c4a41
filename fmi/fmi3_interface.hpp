#pragma once

#include <cstddef>
#include <cstdint>

// The C interface of FMI 3.0, as the standard defines it (sections 2.2, 2.3, 3.2, 4.2 and 5.2):
// types, then the 75 functions that every FMU exports whatever it offers. For the FMU itself, and
// for whoever loads one and needs decltype(&fmi3DoStep).

#if defined(__GNUC__)
#define F3 __attribute__((visibility("default")))
#else
#define F3
#endif

extern "C" {

using fmi3Instance = void*;
using fmi3InstanceEnvironment = void*;
using fmi3FMUState = void*;
using fmi3ValueReference = std::uint32_t;
using fmi3Float32 = float;
using fmi3Float64 = double;
using fmi3Int8 = std::int8_t;
using fmi3UInt8 = std::uint8_t;
using fmi3Int16 = std::int16_t;
using fmi3UInt16 = std::uint16_t;
using fmi3Int32 = std::int32_t;
using fmi3UInt32 = std::uint32_t;
using fmi3Int64 = std::int64_t;
using fmi3UInt64 = std::uint64_t;
using fmi3Boolean = bool;
using fmi3Char = char;
using fmi3String = const char*;
using fmi3Byte = std::uint8_t;
using fmi3Binary = const std::uint8_t*;
using fmi3Clock = bool;

constexpr fmi3Boolean fmi3True = true;
constexpr fmi3Boolean fmi3False = false;

enum fmi3Status { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal };
enum fmi3DependencyKind {
  fmi3Independent,
  fmi3Constant,
  fmi3Fixed,
  fmi3Tunable,
  fmi3Discrete,
  fmi3Dependent
};
enum fmi3IntervalQualifier { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged };

using fmi3LogMessageCallback = void (*)(fmi3InstanceEnvironment environment, fmi3Status status,
                                        fmi3String category, fmi3String message);
using fmi3ClockUpdateCallback = void (*)(fmi3InstanceEnvironment environment);
using fmi3IntermediateUpdateCallback = void (*)(fmi3InstanceEnvironment environment,
                                                fmi3Float64 time, fmi3Boolean set_requested,
                                                fmi3Boolean get_allowed, fmi3Boolean step_finished,
                                                fmi3Boolean can_return_early,
                                                fmi3Boolean* early_return_requested,
                                                fmi3Float64* early_return_time);
using fmi3LockPreemptionCallback = void (*)();
using fmi3UnlockPreemptionCallback = void (*)();

// Life cycle

F3 const char* fmi3GetVersion();
F3 fmi3Status fmi3SetDebugLogging(fmi3Instance i, fmi3Boolean on, std::size_t count,
                                  const fmi3String categories[]);
F3 fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token,
                                             fmi3String resource_path, fmi3Boolean visible,
                                             fmi3Boolean logging_on,
                                             fmi3InstanceEnvironment environment,
                                             fmi3LogMessageCallback log);
F3 fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resource_path, fmi3Boolean visible,
    fmi3Boolean logging_on, fmi3Boolean event_mode_used, fmi3Boolean early_return_allowed,
    const fmi3ValueReference required_intermediate_variables[],
    std::size_t required_intermediate_variable_count, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback intermediate_update);
F3 fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resource_path, fmi3Boolean visible,
    fmi3Boolean logging_on, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3ClockUpdateCallback clock_update, fmi3LockPreemptionCallback lock_preemption,
    fmi3UnlockPreemptionCallback unlock_preemption);
F3 void fmi3FreeInstance(fmi3Instance i);
F3 fmi3Status fmi3EnterInitializationMode(fmi3Instance i, fmi3Boolean tolerance_defined,
                                          fmi3Float64 tolerance, fmi3Float64 start_time,
                                          fmi3Boolean stop_time_defined, fmi3Float64 stop_time);
F3 fmi3Status fmi3ExitInitializationMode(fmi3Instance i);
F3 fmi3Status fmi3EnterEventMode(fmi3Instance i);
F3 fmi3Status fmi3Terminate(fmi3Instance i);
F3 fmi3Status fmi3Reset(fmi3Instance i);

// Variables

F3 fmi3Status fmi3GetFloat32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                             fmi3Float32 v[], std::size_t value_count);
F3 fmi3Status fmi3GetFloat64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                             fmi3Float64 v[], std::size_t value_count);
F3 fmi3Status fmi3GetInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                          fmi3Int8 v[], std::size_t value_count);
F3 fmi3Status fmi3GetUInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                           fmi3UInt8 v[], std::size_t value_count);
F3 fmi3Status fmi3GetInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                           fmi3Int16 v[], std::size_t value_count);
F3 fmi3Status fmi3GetUInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                            fmi3UInt16 v[], std::size_t value_count);
F3 fmi3Status fmi3GetInt32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                           fmi3Int32 v[], std::size_t value_count);
F3 fmi3Status fmi3GetUInt32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                            fmi3UInt32 v[], std::size_t value_count);
F3 fmi3Status fmi3GetInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                           fmi3Int64 v[], std::size_t value_count);
F3 fmi3Status fmi3GetUInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                            fmi3UInt64 v[], std::size_t value_count);
F3 fmi3Status fmi3GetBoolean(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                             fmi3Boolean v[], std::size_t value_count);
F3 fmi3Status fmi3GetString(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                            fmi3String v[], std::size_t value_count);
F3 fmi3Status fmi3GetBinary(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                            std::size_t sizes[], fmi3Binary v[], std::size_t value_count);
F3 fmi3Status fmi3GetClock(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                           fmi3Clock v[]);
F3 fmi3Status fmi3SetFloat32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                             const fmi3Float32 v[], std::size_t value_count);
F3 fmi3Status fmi3SetFloat64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                             const fmi3Float64 v[], std::size_t value_count);
F3 fmi3Status fmi3SetInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                          const fmi3Int8 v[], std::size_t value_count);
F3 fmi3Status fmi3SetUInt8(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                           const fmi3UInt8 v[], std::size_t value_count);
F3 fmi3Status fmi3SetInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                           const fmi3Int16 v[], std::size_t value_count);
F3 fmi3Status fmi3SetUInt16(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                            const fmi3UInt16 v[], std::size_t value_count);
F3 fmi3Status fmi3SetInt32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                           const fmi3Int32 v[], std::size_t value_count);
F3 fmi3Status fmi3SetUInt32(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                            const fmi3UInt32 v[], std::size_t value_count);
F3 fmi3Status fmi3SetInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                           const fmi3Int64 v[], std::size_t value_count);
F3 fmi3Status fmi3SetUInt64(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                            const fmi3UInt64 v[], std::size_t value_count);
F3 fmi3Status fmi3SetBoolean(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                             const fmi3Boolean v[], std::size_t value_count);
F3 fmi3Status fmi3SetString(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                            const fmi3String v[], std::size_t value_count);
F3 fmi3Status fmi3SetBinary(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                            const std::size_t sizes[], const fmi3Binary v[],
                            std::size_t value_count);
F3 fmi3Status fmi3SetClock(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                           const fmi3Clock v[]);
F3 fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance i, fmi3ValueReference vr,
                                                  std::size_t* count);
F3 fmi3Status fmi3GetVariableDependencies(fmi3Instance i, fmi3ValueReference dependent,
                                          std::size_t dependent_elements[],
                                          fmi3ValueReference independents[],
                                          std::size_t independent_elements[],
                                          fmi3DependencyKind kinds[], std::size_t count);

// State

F3 fmi3Status fmi3GetFMUState(fmi3Instance i, fmi3FMUState* state);
F3 fmi3Status fmi3SetFMUState(fmi3Instance i, fmi3FMUState state);
F3 fmi3Status fmi3FreeFMUState(fmi3Instance i, fmi3FMUState* state);
F3 fmi3Status fmi3SerializedFMUStateSize(fmi3Instance i, fmi3FMUState state, std::size_t* size);
F3 fmi3Status fmi3SerializeFMUState(fmi3Instance i, fmi3FMUState state, fmi3Byte bytes[],
                                    std::size_t size);
F3 fmi3Status fmi3DeserializeFMUState(fmi3Instance i, const fmi3Byte bytes[], std::size_t size,
                                      fmi3FMUState* state);

// Derivatives

F3 fmi3Status fmi3GetDirectionalDerivative(fmi3Instance i, const fmi3ValueReference unknowns[],
                                           std::size_t unknown_count,
                                           const fmi3ValueReference knowns[],
                                           std::size_t known_count, const fmi3Float64 seed[],
                                           std::size_t seed_count, fmi3Float64 sensitivity[],
                                           std::size_t sensitivity_count);
F3 fmi3Status fmi3GetAdjointDerivative(fmi3Instance i, const fmi3ValueReference unknowns[],
                                       std::size_t unknown_count, const fmi3ValueReference knowns[],
                                       std::size_t known_count, const fmi3Float64 seed[],
                                       std::size_t seed_count, fmi3Float64 sensitivity[],
                                       std::size_t sensitivity_count);

// Configuration, clocks and events

F3 fmi3Status fmi3EnterConfigurationMode(fmi3Instance i);
F3 fmi3Status fmi3ExitConfigurationMode(fmi3Instance i);
F3 fmi3Status fmi3GetIntervalDecimal(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                     fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[]);
F3 fmi3Status fmi3GetIntervalFraction(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                      fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                      fmi3IntervalQualifier qualifiers[]);
F3 fmi3Status fmi3GetShiftDecimal(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                  fmi3Float64 shifts[]);
F3 fmi3Status fmi3GetShiftFraction(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                   fmi3UInt64 counters[], fmi3UInt64 resolutions[]);
F3 fmi3Status fmi3SetIntervalDecimal(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                     const fmi3Float64 intervals[]);
F3 fmi3Status fmi3SetIntervalFraction(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                      const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]);
F3 fmi3Status fmi3SetShiftDecimal(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                  const fmi3Float64 shifts[]);
F3 fmi3Status fmi3SetShiftFraction(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                   const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]);
F3 fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance i);
F3 fmi3Status fmi3UpdateDiscreteStates(fmi3Instance i, fmi3Boolean* discrete_states_need_update,
                                       fmi3Boolean* terminate_simulation,
                                       fmi3Boolean* nominals_changed, fmi3Boolean* values_changed,
                                       fmi3Boolean* next_event_time_defined,
                                       fmi3Float64* next_event_time);

// Model Exchange

F3 fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance i);
F3 fmi3Status fmi3CompletedIntegratorStep(fmi3Instance i, fmi3Boolean no_set_state_prior,
                                          fmi3Boolean* enter_event_mode,
                                          fmi3Boolean* terminate_simulation);
F3 fmi3Status fmi3SetTime(fmi3Instance i, fmi3Float64 time);
F3 fmi3Status fmi3SetContinuousStates(fmi3Instance i, const fmi3Float64 x[], std::size_t n);
F3 fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance i, fmi3Float64 dx[], std::size_t n);
F3 fmi3Status fmi3GetEventIndicators(fmi3Instance i, fmi3Float64 indicators[], std::size_t n);
F3 fmi3Status fmi3GetContinuousStates(fmi3Instance i, fmi3Float64 x[], std::size_t n);
F3 fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance i, fmi3Float64 nominals[],
                                                std::size_t n);
F3 fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance i, std::size_t* n);
F3 fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance i, std::size_t* n);

// Co-Simulation and Scheduled Execution

F3 fmi3Status fmi3EnterStepMode(fmi3Instance i);
F3 fmi3Status fmi3GetOutputDerivatives(fmi3Instance i, const fmi3ValueReference vr[], std::size_t n,
                                       const fmi3Int32 orders[], fmi3Float64 v[],
                                       std::size_t value_count);
F3 fmi3Status fmi3DoStep(fmi3Instance i, fmi3Float64 communication_point, fmi3Float64 step_size,
                         fmi3Boolean no_set_state_prior_to_current_point,
                         fmi3Boolean* event_handling_needed, fmi3Boolean* terminate_simulation,
                         fmi3Boolean* early_return, fmi3Float64* last_successful_time);
F3 fmi3Status fmi3ActivateModelPartition(fmi3Instance i, fmi3ValueReference clock,
                                         fmi3Float64 activation_time);

}  // extern "C"

#undef F3
