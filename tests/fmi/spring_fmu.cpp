// A small FMU (FMI 2) for the tests of the coupling: a spring between the hand and an anchor, a
// push that is on for a while, and trouble when asked for. Its variables are in spring_fmu.xml.
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <unistd.h>

#include "fmi/fmi2_interface.hpp"

namespace {

enum Reference { kHand = 1, kForce = 4, kPushForce = 7, kImpulse = 10, kFirstParameter = 11 };
enum Trouble { kNone, kCrash, kHang, kExit, kError };

/// Plain data: a saved state is a copy.
struct Spring {
  double time = 0;
  double hand[3] = {0, 0, 0};
  double impulse = 0;  ///< of the spring's force, summed up over its steps [N s]
  double stiffness = 0, anchor[3] = {0, 0, 0};
  double push[3] = {0, 0, 0}, push_start = 0, push_end = 0;
  double trouble_time = 1e9;
  int trouble = kNone;
};

double forceOf(const Spring& s, int axis) { return s.stiffness * (s.anchor[axis] - s.hand[axis]); }

/// Where a variable is stored; null for what is computed.
double* place(Spring& s, fmi2ValueReference vr) {
  double* const parameters[] = {&s.stiffness, &s.anchor[0],   &s.anchor[1], &s.anchor[2],
                                &s.push[0],   &s.push[1],     &s.push[2],   &s.push_start,
                                &s.push_end,  &s.trouble_time};
  if (vr >= kHand && vr < kHand + 3) return &s.hand[vr - kHand];
  if (vr == kImpulse) return &s.impulse;
  if (vr >= kFirstParameter && vr < kFirstParameter + 10) return parameters[vr - kFirstParameter];
  return nullptr;
}

fmi2Status no() { return fmi2Error; }

}  // namespace

extern "C" {

const char* fmi2GetTypesPlatform() { return "default"; }
const char* fmi2GetVersion() { return "2.0"; }
fmi2Status fmi2SetDebugLogging(fmi2Component, fmi2Boolean, std::size_t, const fmi2String[]) {
  return fmi2OK;
}
fmi2Component fmi2Instantiate(fmi2String, fmi2Type, fmi2String, fmi2String,
                              const fmi2CallbackFunctions*, fmi2Boolean, fmi2Boolean) {
  return new Spring;
}
void fmi2FreeInstance(fmi2Component c) { delete static_cast<Spring*>(c); }
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start, fmi2Boolean,
                               fmi2Real) {
  static_cast<Spring*>(c)->time = start;
  return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component) { return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) {
  *static_cast<Spring*>(c) = Spring{};
  return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                       fmi2Real v[]) {
  Spring& s = *static_cast<Spring*>(c);
  for (std::size_t i = 0; i < n; ++i) {
    if (vr[i] >= kForce && vr[i] < kForce + 3) {
      v[i] = forceOf(s, static_cast<int>(vr[i]) - kForce);
    } else if (vr[i] >= kPushForce && vr[i] < kPushForce + 3) {
      const bool on = s.time > s.push_start - 1e-9 && s.time < s.push_end - 1e-9;
      v[i] = on ? s.push[vr[i] - kPushForce] : 0;
    } else if (const double* from = place(s, vr[i])) {
      v[i] = *from;
    } else {
      return fmi2Error;
    }
  }
  return fmi2OK;
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], std::size_t n,
                       const fmi2Real v[]) {
  for (std::size_t i = 0; i < n; ++i) {
    double* to = place(*static_cast<Spring*>(c), vr[i]);
    if (!to) return fmi2Error;
    *to = v[i];
  }
  return fmi2OK;
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference[], std::size_t,
                          const fmi2Integer v[]) {
  static_cast<Spring*>(c)->trouble = v[0];
  return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real, fmi2Real step, fmi2Boolean) {
  Spring& s = *static_cast<Spring*>(c);
  if (s.time + step > s.trouble_time) {
    if (s.trouble == kCrash) std::abort();
    if (s.trouble == kExit) std::_Exit(0);
    if (s.trouble == kError) return fmi2Error;
    while (s.trouble == kHang) ::pause();
  }
  for (int i = 0; i < 3; ++i) s.impulse += forceOf(s, i) * step;
  s.time += step;
  return fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  *state = new Spring(*static_cast<Spring*>(c));
  return fmi2OK;
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  *static_cast<Spring*>(c) = *static_cast<Spring*>(state);
  return fmi2OK;
}
fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate* state) {
  delete static_cast<Spring*>(*state);
  *state = nullptr;
  return fmi2OK;
}
fmi2Status fmi2SerializedFMUstateSize(fmi2Component, fmi2FMUstate, std::size_t* size) {
  *size = sizeof(Spring);
  return fmi2OK;
}
fmi2Status fmi2SerializeFMUstate(fmi2Component, fmi2FMUstate state, fmi2Byte bytes[],
                                 std::size_t size) {
  std::memcpy(bytes, state, size);
  return fmi2OK;
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component, const fmi2Byte bytes[], std::size_t size,
                                   fmi2FMUstate* state) {
  if (size != sizeof(Spring)) return fmi2Error;
  auto* spring = new Spring;
  std::memcpy(static_cast<void*>(spring), bytes, size);
  *state = spring;
  return fmi2OK;
}

// What this FMU has no use for.
fmi2Status fmi2GetInteger(fmi2Component, const fmi2ValueReference[], std::size_t, fmi2Integer[]) {
  return no();
}
fmi2Status fmi2GetBoolean(fmi2Component, const fmi2ValueReference[], std::size_t, fmi2Boolean[]) {
  return no();
}
fmi2Status fmi2GetString(fmi2Component, const fmi2ValueReference[], std::size_t, fmi2String[]) {
  return no();
}
fmi2Status fmi2SetBoolean(fmi2Component, const fmi2ValueReference[], std::size_t,
                          const fmi2Boolean[]) {
  return no();
}
fmi2Status fmi2SetString(fmi2Component, const fmi2ValueReference[], std::size_t,
                         const fmi2String[]) {
  return no();
}
fmi2Status fmi2GetDirectionalDerivative(fmi2Component, const fmi2ValueReference[], std::size_t,
                                        const fmi2ValueReference[], std::size_t, const fmi2Real[],
                                        fmi2Real[]) {
  return no();
}
fmi2Status fmi2SetRealInputDerivatives(fmi2Component, const fmi2ValueReference[], std::size_t,
                                       const fmi2Integer[], const fmi2Real[]) {
  return no();
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component, const fmi2ValueReference[], std::size_t,
                                        const fmi2Integer[], fmi2Real[]) {
  return no();
}
fmi2Status fmi2CancelStep(fmi2Component) { return no(); }
fmi2Status fmi2GetStatus(fmi2Component, const fmi2StatusKind, fmi2Status*) { return no(); }
fmi2Status fmi2GetRealStatus(fmi2Component, const fmi2StatusKind, fmi2Real*) { return no(); }
fmi2Status fmi2GetIntegerStatus(fmi2Component, const fmi2StatusKind, fmi2Integer*) { return no(); }
fmi2Status fmi2GetBooleanStatus(fmi2Component, const fmi2StatusKind, fmi2Boolean*) { return no(); }
fmi2Status fmi2GetStringStatus(fmi2Component, const fmi2StatusKind, fmi2String*) { return no(); }

}  // extern "C"
