#pragma once

#include <cstddef>

// The C interface of FMI 2.0 for Co-Simulation, as the standard defines it (sections 2.1 and 4.2):
// types, then the 34 functions a Co-Simulation FMU exports. For the FMU itself, and for whoever
// loads one and needs decltype(&fmi2DoStep).

#if defined(__GNUC__)
#define BALLBOT_FMI_EXPORT __attribute__((visibility("default")))
#else
#define BALLBOT_FMI_EXPORT
#endif

extern "C" {

using fmi2Component = void*;
using fmi2ComponentEnvironment = void*;
using fmi2FMUstate = void*;
using fmi2ValueReference = unsigned int;
using fmi2Real = double;
using fmi2Integer = int;
using fmi2Boolean = int;
using fmi2Char = char;
using fmi2String = const char*;
using fmi2Byte = char;

constexpr fmi2Boolean fmi2True = 1;
constexpr fmi2Boolean fmi2False = 0;

enum fmi2Status { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending };
enum fmi2Type { fmi2ModelExchange, fmi2CoSimulation };
enum fmi2StatusKind { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated };

using fmi2CallbackLogger = void (*)(fmi2ComponentEnvironment environment, fmi2String instance_name,
                                    fmi2Status status, fmi2String category, fmi2String format, ...);
using fmi2CallbackAllocateMemory = void* (*)(std::size_t count, std::size_t size);
using fmi2CallbackFreeMemory = void (*)(void* memory);
using fmi2StepFinished = void (*)(fmi2ComponentEnvironment environment, fmi2Status status);

struct fmi2CallbackFunctions {
  fmi2CallbackLogger logger;
  fmi2CallbackAllocateMemory allocateMemory;
  fmi2CallbackFreeMemory freeMemory;
  fmi2StepFinished stepFinished;
  fmi2ComponentEnvironment componentEnvironment;
};

#define F2 BALLBOT_FMI_EXPORT

F2 const char* fmi2GetTypesPlatform();
F2 const char* fmi2GetVersion();
F2 fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, std::size_t count,
                                  const fmi2String categories[]);

F2 fmi2Component fmi2Instantiate(fmi2String instance_name, fmi2Type type, fmi2String guid,
                                 fmi2String resource_location,
                                 const fmi2CallbackFunctions* functions, fmi2Boolean visible,
                                 fmi2Boolean logging_on);
F2 void fmi2FreeInstance(fmi2Component c);

F2 fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined,
                                  fmi2Real tolerance, fmi2Real start_time,
                                  fmi2Boolean stop_time_defined, fmi2Real stop_time);
F2 fmi2Status fmi2EnterInitializationMode(fmi2Component c);
F2 fmi2Status fmi2ExitInitializationMode(fmi2Component c);
F2 fmi2Status fmi2Terminate(fmi2Component c);
F2 fmi2Status fmi2Reset(fmi2Component c);

F2 fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                          fmi2Real v[]);
F2 fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                             fmi2Integer v[]);
F2 fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                             fmi2Boolean v[]);
F2 fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                            fmi2String v[]);
F2 fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                          const fmi2Real v[]);
F2 fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                             const fmi2Integer v[]);
F2 fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                             const fmi2Boolean v[]);
F2 fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                            const fmi2String v[]);

F2 fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state);
F2 fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state);
F2 fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state);
F2 fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, std::size_t* size);
F2 fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                    std::size_t size);
F2 fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], std::size_t size,
                                      fmi2FMUstate* state);

F2 fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[],
                                           std::size_t unknown_count,
                                           const fmi2ValueReference known[],
                                           std::size_t known_count, const fmi2Real known_seed[],
                                           fmi2Real unknown_sensitivity[]);

F2 fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[],
                                          std::size_t n, const fmi2Integer order[],
                                          const fmi2Real v[]);
F2 fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[],
                                           std::size_t n, const fmi2Integer order[], fmi2Real v[]);

F2 fmi2Status fmi2DoStep(fmi2Component c, fmi2Real communication_point, fmi2Real step_size,
                         fmi2Boolean no_set_state_prior_to_current_point);
F2 fmi2Status fmi2CancelStep(fmi2Component c);

F2 fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status* v);
F2 fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real* v);
F2 fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer* v);
F2 fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean* v);
F2 fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String* v);

#undef F2

}  // extern "C"
