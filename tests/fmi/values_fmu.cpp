// A small FMU (FMI 3) for the tests of the import: it gives back what it is given, in every type of
// number. It has what Co-Simulation needs and no function more, as widespread tools write them.
#include <cstdint>

#include "fmi/fmi3_interface.hpp"

namespace {

// An output's reference is its input's and 100 more; see valuesFmu() in small_fmus.cpp.
enum Reference : fmi3ValueReference { kOutputs = 100, kMatrix = 200, kHuge = 201 };

struct Values {
  double given[kOutputs] = {};
};

template <typename T>
fmi3Status get(fmi3Instance instance, const fmi3ValueReference vr[], T values[], std::size_t n) {
  const Values& all = *static_cast<Values*>(instance);
  for (std::size_t i = 0; i < n; ++i) {
    values[i] = vr[0] == kMatrix ? static_cast<T>(10 * i)
                : vr[0] == kHuge ? static_cast<T>((std::uint64_t{1} << 60) + 1)
                                 : static_cast<T>(all.given[vr[0] % kOutputs]);
  }
  return fmi3OK;
}
template <typename T>
fmi3Status set(fmi3Instance instance, const fmi3ValueReference vr[], const T values[]) {
  static_cast<Values*>(instance)->given[vr[0] % kOutputs] = static_cast<double>(values[0]);
  return fmi3OK;
}

}  // namespace

extern "C" {

#define BALLBOT_TYPE(name)                                                             \
  fmi3Status fmi3Get##name(fmi3Instance i, const fmi3ValueReference vr[], std::size_t, \
                           fmi3##name v[], std::size_t n) {                            \
    return get(i, vr, v, n);                                                           \
  }                                                                                    \
  fmi3Status fmi3Set##name(fmi3Instance i, const fmi3ValueReference vr[], std::size_t, \
                           const fmi3##name v[], std::size_t) {                        \
    return set(i, vr, v);                                                              \
  }
BALLBOT_TYPE(Float32)
BALLBOT_TYPE(Float64)
BALLBOT_TYPE(Int8)
BALLBOT_TYPE(UInt8)
BALLBOT_TYPE(Int16)
BALLBOT_TYPE(UInt16)
BALLBOT_TYPE(Int32)
BALLBOT_TYPE(UInt32)
BALLBOT_TYPE(Int64)
BALLBOT_TYPE(UInt64)
BALLBOT_TYPE(Boolean)
#undef BALLBOT_TYPE

const char* fmi3GetVersion() { return "3.0"; }
fmi3Instance fmi3InstantiateCoSimulation(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                         fmi3Boolean, fmi3Boolean, fmi3Boolean,
                                         const fmi3ValueReference[], std::size_t,
                                         fmi3InstanceEnvironment, fmi3LogMessageCallback,
                                         fmi3IntermediateUpdateCallback) {
  return new Values;
}
void fmi3FreeInstance(fmi3Instance i) { delete static_cast<Values*>(i); }
fmi3Status fmi3EnterInitializationMode(fmi3Instance, fmi3Boolean, fmi3Float64, fmi3Float64,
                                       fmi3Boolean, fmi3Float64) {
  return fmi3OK;
}
fmi3Status fmi3ExitInitializationMode(fmi3Instance) { return fmi3OK; }
fmi3Status fmi3Terminate(fmi3Instance) { return fmi3OK; }
fmi3Status fmi3DoStep(fmi3Instance, fmi3Float64, fmi3Float64, fmi3Boolean, fmi3Boolean*,
                      fmi3Boolean*, fmi3Boolean*, fmi3Float64*) {
  return fmi3OK;
}

}  // extern "C"
