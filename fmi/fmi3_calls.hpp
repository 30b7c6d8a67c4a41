#pragma once

#include <cstddef>
#include <string>
#include <type_traits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "fmi/fmi3_interface.hpp"
#include "fmi/fmu_instance.hpp"

// What the functions of the FMI 3 interface (fmi3_plant.cpp) share.
namespace ballbot {

inline FmuInstance* instanceOf(fmi3Instance i) { return static_cast<FmuInstance*>(i); }

/// Runs `work(instance)`; any exception becomes a line in the log and fmi3Error.
template <typename Work>
fmi3Status attempt(fmi3Instance i, const char* function, Work&& work) noexcept {
  FmuInstance* instance = instanceOf(i);
  if (!instance) return fmi3Error;
  return instance->attempt(function, [&] { work(*instance); }) ? fmi3OK : fmi3Error;
}

inline fmi3Status unsupported(fmi3Instance i, const char* function, const char* why) noexcept {
  return attempt(i, function, [&](FmuInstance&) { throw InputError(why); });
}

inline void require(const void* pointer, const char* what) {
  if (!pointer) throw InputError(fmt::format("{} is a null pointer", what));
}

/// The variable that `vr` names, which must have one of our types: Float64, Int64 (counts and
/// enumerations) or Boolean.
inline const FmuVariable& variable(FmuInstance& f, fmi3ValueReference vr, VariableType type) {
  const FmuVariable* v = f.fmu.variables().find(vr);
  if (!v || v->reference != vr) {
    throw InputError(fmt::format("there is no variable with value reference {}", vr));
  }
  const bool integer = v->type == VariableType::kInteger || v->type == VariableType::kEnumeration;
  if (type == VariableType::kInteger ? !integer : v->type != type) {
    throw InputError(fmt::format("'{}' (value reference {}) is of another type", v->name, vr));
  }
  return *v;
}

/// Calls `work(reference, index)` for every element of the variables named, after having checked
/// that their sizes sum up to `count`.
template <typename Work>
void forElements(FmuInstance& f, VariableType type, const fmi3ValueReference vr[], std::size_t n,
                 const void* values, std::size_t count, Work&& work) {
  if (n > 0) require(vr, "valueReferences");
  if (n > 0) require(values, "values");
  std::size_t sum = 0;
  for (std::size_t k = 0; k < n; ++k)
    sum += static_cast<std::size_t>(variable(f, vr[k], type).size);
  if (sum != count) {
    throw InputError(
        fmt::format("nValues is {}, but the {} variables have {} values", count, n, sum));
  }
  std::size_t index = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const FmuVariable& v = variable(f, vr[k], type);
    for (int e = 0; e < v.size; ++e) work(v.reference + static_cast<ValueReference>(e), index++);
  }
}

template <typename T>
fmi3Status get(fmi3Instance i, const char* function, VariableType type,
               const fmi3ValueReference vr[], std::size_t n, T out[], std::size_t count) noexcept {
  return attempt(i, function, [&](FmuInstance& f) {
    forElements(f, type, vr, n, out, count, [&](ValueReference r, std::size_t k) {
      if constexpr (std::is_same_v<T, bool>) {
        out[k] = f.fmu.value(r) != 0;
      } else {
        out[k] = static_cast<T>(f.fmu.value(r));
      }
    });
  });
}

template <typename T>
fmi3Status set(fmi3Instance i, const char* function, VariableType type,
               const fmi3ValueReference vr[], std::size_t n, const T in[],
               std::size_t count) noexcept {
  return attempt(i, function, [&](FmuInstance& f) {
    forElements(f, type, vr, n, in, count, [&](ValueReference r, std::size_t k) {
      f.fmu.setValue(r, static_cast<double>(in[k]));
    });
  });
}

/// For types that no variable has: only an empty request can be met.
inline fmi3Status none(fmi3Instance i, const char* function, std::size_t n) noexcept {
  return attempt(i, function, [&](FmuInstance&) {
    if (n > 0) throw InputError("this FMU has no variables of this type");
  });
}

inline fmi3Instance refuse(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                           const char* text) noexcept {
  try {
    if (log) log(environment, fmi3Error, kLogErrors, logText(text).c_str());
  } catch (...) {
  }
  return nullptr;
}

constexpr const char* kNoEvents = "this FMU has no event mode, as hasEventMode=false says";
constexpr const char* kNoClocks = "this FMU has no clocks";
constexpr const char* kNoStructure = "this FMU has no structural parameters";
constexpr const char* kCoSimulationOnly = "this FMU is for Co-Simulation only";

}  // namespace ballbot
