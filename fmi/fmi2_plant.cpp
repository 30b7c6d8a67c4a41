// The plant as an FMI 2.0 Co-Simulation FMU: the 34 functions of the standard over PlantFmu.
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/error.hpp"
#include "fmi/file_uri.hpp"
#include "fmi/fmi2_interface.hpp"
#include "fmi/fmu_instance.hpp"
#include "fmi/step_time.hpp"

using namespace ballbot;

namespace {

FmuInstance* instanceOf(fmi2Component c) { return static_cast<FmuInstance*>(c); }

/// Runs `work(instance)`; any exception becomes a line in the log and fmi2Error.
template <typename Work>
fmi2Status attempt(fmi2Component c, const char* function, Work&& work) noexcept {
  FmuInstance* instance = instanceOf(c);
  if (!instance) return fmi2Error;
  return instance->attempt(function, [&] { work(*instance); }) ? fmi2OK : fmi2Error;
}

void require(const void* pointer, const char* what) {
  if (!pointer) throw InputError(fmt::format("{} is a null pointer", what));
}

bool hasType(const FmuVariable& v, VariableType type) {
  // Enumerations are set and read as integers.
  return v.type == type || (type == VariableType::kInteger && v.type == VariableType::kEnumeration);
}

const char* typeName(VariableType type) {
  return type == VariableType::kReal      ? "Real"
         : type == VariableType::kBoolean ? "Boolean"
                                          : "Integer";
}

void requireType(FmuInstance& f, fmi2ValueReference vr, VariableType type) {
  const FmuVariable* v = f.fmu.variables().find(vr);
  if (!v) throw InputError(fmt::format("there is no variable with value reference {}", vr));
  if (!hasType(*v, type)) {
    throw InputError(
        fmt::format("'{}' (value reference {}) is no {}", v->name, vr, typeName(type)));
  }
}

template <typename T>
fmi2Status get(fmi2Component c, const char* function, VariableType type,
               const fmi2ValueReference vr[], std::size_t n, T out[]) noexcept {
  return attempt(c, function, [&](FmuInstance& f) {
    if (n == 0) return;
    require(vr, "vr");
    require(out, "value");
    for (std::size_t i = 0; i < n; ++i) {
      requireType(f, vr[i], type);
      const double value = f.fmu.value(vr[i]);
      if (std::is_integral_v<T> && std::abs(value) > std::numeric_limits<fmi2Integer>::max()) {
        throw InputError(
            fmt::format("value reference {} is {}, too large for an Integer", vr[i], value));
      }
      out[i] = static_cast<T>(value);
    }
  });
}

template <typename T>
fmi2Status set(fmi2Component c, const char* function, VariableType type,
               const fmi2ValueReference vr[], std::size_t n, const T in[]) noexcept {
  return attempt(c, function, [&](FmuInstance& f) {
    if (n == 0) return;
    require(vr, "vr");
    require(in, "value");
    for (std::size_t i = 0; i < n; ++i) {
      requireType(f, vr[i], type);
      const auto value = static_cast<double>(in[i]);
      f.fmu.setValue(vr[i], type == VariableType::kBoolean ? (value != 0 ? 1.0 : 0.0) : value);
    }
  });
}

fmi2Status unsupported(fmi2Component c, const char* function, const char* why) noexcept {
  return attempt(c, function, [&](FmuInstance&) { throw InputError(why); });
}

/// The only status that can be asked for: steps are done when doStep returns.
template <typename T>
fmi2Status getStatus(fmi2Component c, const char* function, fmi2StatusKind kind,
                     fmi2StatusKind only, T* out, T value) noexcept {
  return attempt(c, function, [&](FmuInstance&) {
    require(out, "value");
    if (kind != only)
      throw InputError(fmt::format("status kind {} is of another type", static_cast<int>(kind)));
    *out = value;
  });
}

constexpr const char* kNoStrings = "this FMU has no String variables";

}  // namespace

extern "C" {

const char* fmi2GetTypesPlatform() { return "default"; }
const char* fmi2GetVersion() { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, std::size_t count,
                               const fmi2String categories[]) {
  return attempt(c, "fmi2SetDebugLogging",
                 [&](FmuInstance& f) { f.setLogging(on != fmi2False, count, categories); });
}

fmi2Component fmi2Instantiate(fmi2String instance_name, fmi2Type type, fmi2String guid,
                              fmi2String resource_location, const fmi2CallbackFunctions* functions,
                              fmi2Boolean /*visible*/, fmi2Boolean logging_on) {
  if (!functions) return nullptr;
  const fmi2CallbackFunctions callbacks = *functions;
  try {
    const std::string name = instance_name ? instance_name : "";
    const auto log = [callbacks, name](fmi2Status status, const char* category, const char* text) {
      if (!callbacks.logger) return;
      callbacks.logger(callbacks.componentEnvironment, name.c_str(), status, category, "%s", text);
    };
    try {
      if (name.find_first_not_of(" \t\r\n") == std::string::npos)
        throw InputError("the instance name is empty");
      if (type != fmi2CoSimulation) throw InputError("this FMU is for Co-Simulation only");
      if (!guid) throw InputError("the GUID is missing");
      auto instance = std::make_unique<FmuInstance>(
          resourcePath(resource_location), guid, 2,
          [log](const char* category, const std::string& text) {
            log(category == std::string(kLogErrors) ? fmi2Error : fmi2OK, category, text.c_str());
          });
      instance->setLogging(logging_on != fmi2False, 0, nullptr);
      return instance.release();
    } catch (const std::exception& e) {
      log(fmi2Error, kLogErrors, logText(std::string("fmi2Instantiate: ") + e.what()).c_str());
    }
  } catch (...) {
  }
  return nullptr;
}

void fmi2FreeInstance(fmi2Component c) { delete instanceOf(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean /*tolerance_defined*/,
                               fmi2Real /*tolerance*/, fmi2Real start_time,
                               fmi2Boolean stop_time_defined, fmi2Real stop_time) {
  return attempt(c, "fmi2SetupExperiment", [&](FmuInstance& f) {
    f.fmu.setTimes(start_time, stop_time_defined != fmi2False ? std::optional<double>(stop_time)
                                                              : std::nullopt);
  });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return attempt(c, "fmi2EnterInitializationMode",
                 [](FmuInstance& f) { f.fmu.enterInitialization(); });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return attempt(c, "fmi2ExitInitializationMode", [](FmuInstance& f) {
    f.fmu.exitInitialization();
    f.note("initialized at " + toText(f.fmu.now()));
  });
}

fmi2Status fmi2Terminate(fmi2Component c) {
  return attempt(c, "fmi2Terminate", [](FmuInstance& f) {
    f.fmu.terminate();
    f.note("terminated at " + toText(f.fmu.now()));
  });
}

fmi2Status fmi2Reset(fmi2Component c) {
  return attempt(c, "fmi2Reset", [](FmuInstance& f) { f.fmu.reset(); });
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                       fmi2Real v[]) {
  return get(c, "fmi2GetReal", VariableType::kReal, vr, n, v);
}
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                          fmi2Integer v[]) {
  return get(c, "fmi2GetInteger", VariableType::kInteger, vr, n, v);
}
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                          fmi2Boolean v[]) {
  return get(c, "fmi2GetBoolean", VariableType::kBoolean, vr, n, v);
}
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference[], std::size_t n, fmi2String[]) {
  return n == 0 ? attempt(c, "fmi2GetString", [](FmuInstance&) {})
                : unsupported(c, "fmi2GetString", kNoStrings);
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                       const fmi2Real v[]) {
  return set(c, "fmi2SetReal", VariableType::kReal, vr, n, v);
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                          const fmi2Integer v[]) {
  return set(c, "fmi2SetInteger", VariableType::kInteger, vr, n, v);
}
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                          const fmi2Boolean v[]) {
  return set(c, "fmi2SetBoolean", VariableType::kBoolean, vr, n, v);
}
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference[], std::size_t n,
                         const fmi2String[]) {
  return n == 0 ? attempt(c, "fmi2SetString", [](FmuInstance&) {})
                : unsupported(c, "fmi2SetString", kNoStrings);
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return attempt(c, "fmi2GetFMUstate", [&](FmuInstance& f) { f.getState(state); });
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return attempt(c, "fmi2SetFMUstate", [&](FmuInstance& f) { f.setState(state); });
}
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return attempt(c, "fmi2FreeFMUstate", [&](FmuInstance& f) { f.freeState(state); });
}
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, std::size_t* size) {
  return attempt(c, "fmi2SerializedFMUstateSize", [&](FmuInstance& f) {
    require(size, "size");
    *size = f.stateSize(state);
  });
}
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                 std::size_t size) {
  return attempt(c, "fmi2SerializeFMUstate",
                 [&](FmuInstance& f) { f.serialize(state, bytes, size); });
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], std::size_t size,
                                   fmi2FMUstate* state) {
  return attempt(c, "fmi2DeSerializeFMUstate",
                 [&](FmuInstance& f) { f.deserialize(bytes, size, state); });
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference[], std::size_t,
                                        const fmi2ValueReference[], std::size_t, const fmi2Real[],
                                        fmi2Real[]) {
  return unsupported(c, "fmi2GetDirectionalDerivative",
                     "not provided, as providesDirectionalDerivative=false says");
}
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference[], std::size_t,
                                       const fmi2Integer[], const fmi2Real[]) {
  return unsupported(c, "fmi2SetRealInputDerivatives",
                     "inputs are held during a step, as canInterpolateInputs=false says");
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference[], std::size_t,
                                        const fmi2Integer[], fmi2Real[]) {
  return unsupported(c, "fmi2GetRealOutputDerivatives",
                     "not provided, as maxOutputDerivativeOrder=0 says");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real communication_point, fmi2Real step_size,
                      fmi2Boolean /*no_set_state_prior_to_current_point*/) {
  return attempt(c, "fmi2DoStep",
                 [&](FmuInstance& f) { f.fmu.doStep(communication_point, step_size); });
}
fmi2Status fmi2CancelStep(fmi2Component c) {
  return unsupported(c, "fmi2CancelStep",
                     "no step is in progress: fmi2DoStep ends before it returns");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status* v) {
  return getStatus(c, "fmi2GetStatus", kind, fmi2DoStepStatus, v, fmi2OK);
}
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real* v) {
  const double now = c ? secondsOf(instanceOf(c)->fmu.now()) : 0;
  return getStatus(c, "fmi2GetRealStatus", kind, fmi2LastSuccessfulTime, v, now);
}
fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind, fmi2Integer*) {
  return unsupported(c, "fmi2GetIntegerStatus", "no status is an Integer");
}
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean* v) {
  return getStatus(c, "fmi2GetBooleanStatus", kind, fmi2Terminated, v, fmi2False);
}
fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String* v) {
  return getStatus(c, "fmi2GetStringStatus", kind, fmi2PendingStatus, v,
                   static_cast<fmi2String>(""));
}

}  // extern "C"
