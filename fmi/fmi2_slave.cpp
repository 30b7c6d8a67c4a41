#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "core/error.hpp"
#include "fmi/file_uri.hpp"
#include "fmi/fmi2_library.hpp"
#include "fmi/fmu_slave.hpp"
#include "fmi/step_time.hpp"

namespace ballbot {
namespace {

/// What an FMU says; its address is the component environment.
struct Ear {
  std::function<void(const std::string&)> say;
  std::string last_error;
};

void hear(fmi2ComponentEnvironment environment, fmi2String, fmi2Status status, fmi2String,
          fmi2String format, ...) {
  char text[2000];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format ? format : "", arguments);
  va_end(arguments);
  auto* ear = static_cast<Ear*>(environment);
  if (!ear) return;
  if (status == fmi2OK || status == fmi2Warning) {
    if (ear->say) ear->say(text);
  } else {
    ear->last_error = text;
  }
}

class Fmi2Slave final : public FmuSlave {
 public:
  Fmi2Slave(const FmuDescription& fmu, const std::string& folder, const std::string& instance_name,
            std::function<void(const std::string&)> say)
      : file_(fmu.file), ear_{std::move(say), ""}, fmu_(folder + "/" + fmu.binaryPath()) {
    callbacks_ = {hear, std::calloc, std::free, nullptr, &ear_};
    instance_ = fmu_.fmi2Instantiate(instance_name.c_str(), fmi2CoSimulation, fmu.token.c_str(),
                                     fileUri(folder + "/resources").c_str(), &callbacks_, fmi2False,
                                     fmi2False);
    if (!instance_)
      throw InputError(fmt::format("{}: cannot be instantiated: {}", file_, ear_.last_error));
  }
  ~Fmi2Slave() override { fmu_.fmi2FreeInstance(instance_); }

  std::string name() const override { return file_; }

  void enterInitializationMode(SimTime start) override {
    check(fmu_.fmi2SetupExperiment(instance_, fmi2False, 0, secondsOf(start), fmi2False, 0),
          "fmi2SetupExperiment");
    check(fmu_.fmi2EnterInitializationMode(instance_), "fmi2EnterInitializationMode");
  }
  void exitInitializationMode() override {
    check(fmu_.fmi2ExitInitializationMode(instance_), "fmi2ExitInitializationMode");
  }
  void doStep(SimTime now, SimDuration step) override {
    check(fmu_.fmi2DoStep(instance_, secondsOf(now), secondsOf(kSimStart + step), fmi2False),
          "fmi2DoStep");
  }
  void terminate() override { check(fmu_.fmi2Terminate(instance_), "fmi2Terminate"); }
  void reset() override { check(fmu_.fmi2Reset(instance_), "fmi2Reset"); }

  void get(const FmuPort& port, double* values) override {
    for (const ImportedVariable& v : port.variables) {
      int whole = 0;
      switch (v.facts->kind) {
        case ValueKind::kReal:
          check(fmu_.fmi2GetReal(instance_, &v.reference, 1, values), "fmi2GetReal");
          break;
        case ValueKind::kBoolean:
          check(fmu_.fmi2GetBoolean(instance_, &v.reference, 1, &whole), "fmi2GetBoolean");
          *values = whole != 0;
          break;
        default:
          check(fmu_.fmi2GetInteger(instance_, &v.reference, 1, &whole), "fmi2GetInteger");
          *values = whole;
      }
      ++values;
    }
  }
  void set(const FmuPort& port, const double* values) override {
    for (const ImportedVariable& v : port.variables) {
      requireTaken(v, *values);
      const int whole = v.facts->kind == ValueKind::kReal ? 0 : static_cast<int>(*values);
      switch (v.facts->kind) {
        case ValueKind::kReal:
          check(fmu_.fmi2SetReal(instance_, &v.reference, 1, values), "fmi2SetReal");
          break;
        case ValueKind::kBoolean:
          check(fmu_.fmi2SetBoolean(instance_, &v.reference, 1, &whole), "fmi2SetBoolean");
          break;
        default:
          check(fmu_.fmi2SetInteger(instance_, &v.reference, 1, &whole), "fmi2SetInteger");
      }
      ++values;
    }
  }

  StateBlob saveState() const override {
    fmi2FMUstate state = nullptr;
    check(fmu_.fmi2GetFMUstate(instance_, &state), "fmi2GetFMUstate");
    std::size_t size = 0;
    check(fmu_.fmi2SerializedFMUstateSize(instance_, state, &size), "fmi2SerializedFMUstateSize");
    StateBlob blob(size);
    check(fmu_.fmi2SerializeFMUstate(instance_, state, reinterpret_cast<char*>(blob.data()), size),
          "fmi2SerializeFMUstate");
    check(fmu_.fmi2FreeFMUstate(instance_, &state), "fmi2FreeFMUstate");
    return blob;
  }
  void restoreState(const StateBlob& blob) override {
    fmi2FMUstate state = nullptr;
    check(fmu_.fmi2DeSerializeFMUstate(instance_, reinterpret_cast<const char*>(blob.data()),
                                       blob.size(), &state),
          "fmi2DeSerializeFMUstate");
    const fmi2Status status = fmu_.fmi2SetFMUstate(instance_, state);
    fmu_.fmi2FreeFMUstate(instance_, &state);
    check(status, "fmi2SetFMUstate");
  }

 private:
  void requireTaken(const ImportedVariable& v, double value) const {
    const std::string refusal = refusalOf(v, value);
    if (refusal.empty()) return;
    throw NumericalError(
        fmt::format("{}: '{}' would be set to {}; it {}", file_, v.name, value, refusal));
  }
  void check(fmi2Status status, const char* call) const {
    if (status == fmi2OK || status == fmi2Warning) return;
    fmu_.library.require({call});  // says so if that is why
    throw NumericalError(fmt::format("{}: {} returned {}: {}", file_, call,
                                     status == fmi2Discard ? "discard" : "an error",
                                     ear_.last_error));
  }

  std::string file_;
  Ear ear_;
  Fmi2Library fmu_;
  fmi2CallbackFunctions callbacks_{};
  fmi2Component instance_ = nullptr;
};

}  // namespace

std::unique_ptr<FmuSlave> loadFmi2(const FmuDescription& fmu, const std::string& folder,
                                   const std::string& instance_name,
                                   std::function<void(const std::string&)> say) {
  return std::make_unique<Fmi2Slave>(fmu, folder, instance_name, std::move(say));
}

}  // namespace ballbot
