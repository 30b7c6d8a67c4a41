#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "fmi/fmi3_library.hpp"
#include "fmi/fmu_slave.hpp"
#include "fmi/step_time.hpp"

namespace ballbot {
namespace {

struct Ear {
  std::function<void(const std::string&)> say;
  std::string last_error;
};

void hear(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String, fmi3String message) {
  auto* ear = static_cast<Ear*>(environment);
  if (!ear || !message) return;
  if (status == fmi3OK || status == fmi3Warning) {
    if (ear->say) ear->say(message);
  } else {
    ear->last_error = message;
  }
}

class Fmi3Slave final : public FmuSlave {
 public:
  Fmi3Slave(const FmuDescription& fmu, const std::string& folder, const std::string& instance_name,
            std::function<void(const std::string&)> say)
      : file_(fmu.file), ear_{std::move(say), ""}, fmu_(folder + "/" + fmu.binaryPath()) {
    // Logging on, or an FMI 3 FMU may not even say why it refuses.
    instance_ = fmu_.fmi3InstantiateCoSimulation(instance_name.c_str(), fmu.token.c_str(),
                                                 (folder + "/resources/").c_str(), false, true,
                                                 false, false, nullptr, 0, &ear_, hear, nullptr);
    if (!instance_)
      throw InputError(fmt::format("{}: cannot be instantiated: {}", file_, ear_.last_error));
  }
  ~Fmi3Slave() override { fmu_.fmi3FreeInstance(instance_); }

  void initialize(SimTime start) override {
    check(fmu_.fmi3EnterInitializationMode(instance_, false, 0, secondsOf(start), false, 0),
          "fmi3EnterInitializationMode");
    check(fmu_.fmi3ExitInitializationMode(instance_), "fmi3ExitInitializationMode");
  }
  void step(SimTime now, SimDuration step) override {
    bool event = false, terminate = false, early = false;
    double reached = 0;
    check(fmu_.fmi3DoStep(instance_, secondsOf(now), secondsOf(kSimStart + step), false, &event,
                          &terminate, &early, &reached),
          "fmi3DoStep");
    if (terminate || early) {
      throw NumericalError(fmt::format("{}: ended by itself at {} s", file_, reached));
    }
  }
  void terminate() override { check(fmu_.fmi3Terminate(instance_), "fmi3Terminate"); }
  void reset() override { check(fmu_.fmi3Reset(instance_), "fmi3Reset"); }

  void get(const FmuPort& port, double* values) override {
    for (const ImportedVariable& v : port.variables) {
      const auto n = static_cast<std::size_t>(v.size);
      if (v.type == "Float64") {
        check(fmu_.fmi3GetFloat64(instance_, &v.reference, 1, values, n), "fmi3GetFloat64");
      } else if (v.type == "Int64" || v.type == "Enumeration") {
        fetch<fmi3Int64>(fmu_.fmi3GetInt64, v, values);
      } else if (v.type == "Int32") {
        fetch<fmi3Int32>(fmu_.fmi3GetInt32, v, values);
      } else if (v.type == "Boolean") {
        fetch<fmi3Boolean>(fmu_.fmi3GetBoolean, v, values);
      } else {
        refuse(v);
      }
      values += v.size;
    }
  }
  void set(const FmuPort& port, const double* values) override {
    for (const ImportedVariable& v : port.variables) {
      const auto n = static_cast<std::size_t>(v.size);
      if (v.type == "Float64") {
        check(fmu_.fmi3SetFloat64(instance_, &v.reference, 1, values, n), "fmi3SetFloat64");
      } else if (v.type == "Int64" || v.type == "Enumeration") {
        give<fmi3Int64>(fmu_.fmi3SetInt64, v, values);
      } else if (v.type == "Int32") {
        give<fmi3Int32>(fmu_.fmi3SetInt32, v, values);
      } else if (v.type == "Boolean") {
        give<fmi3Boolean>(fmu_.fmi3SetBoolean, v, values);
      } else {
        refuse(v);
      }
      values += v.size;
    }
  }

  StateBlob save() override {
    fmi3FMUState state = nullptr;
    check(fmu_.fmi3GetFMUState(instance_, &state), "fmi3GetFMUState");
    std::size_t size = 0;
    check(fmu_.fmi3SerializedFMUStateSize(instance_, state, &size), "fmi3SerializedFMUStateSize");
    StateBlob blob(size);
    check(fmu_.fmi3SerializeFMUState(instance_, state, blob.data(), size), "fmi3SerializeFMUState");
    check(fmu_.fmi3FreeFMUState(instance_, &state), "fmi3FreeFMUState");
    return blob;
  }
  void restore(const StateBlob& blob) override {
    fmi3FMUState state = nullptr;
    check(fmu_.fmi3DeserializeFMUState(instance_, blob.data(), blob.size(), &state),
          "fmi3DeserializeFMUState");
    const fmi3Status status = fmu_.fmi3SetFMUState(instance_, state);
    fmu_.fmi3FreeFMUState(instance_, &state);
    check(status, "fmi3SetFMUState");
  }

 private:
  template <typename T, typename Function>
  void fetch(Function function, const ImportedVariable& v, double* values) {
    const auto n = static_cast<std::size_t>(v.size);
    const std::unique_ptr<T[]> whole(new T[n]());
    check(function(instance_, &v.reference, 1, whole.get(), n), "getting a variable");
    for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<double>(whole[i]);
  }
  template <typename T, typename Function>
  void give(Function function, const ImportedVariable& v, const double* values) {
    const auto n = static_cast<std::size_t>(v.size);
    const std::unique_ptr<T[]> whole(new T[n]());
    for (std::size_t i = 0; i < n; ++i) whole[i] = static_cast<T>(values[i]);
    check(function(instance_, &v.reference, 1, whole.get(), n), "setting a variable");
  }
  [[noreturn]] void refuse(const ImportedVariable& v) const {
    throw InputError(
        fmt::format("{}: '{}' is of type {}; Float64, Int32, Int64, Enumeration and Boolean can be "
                    "connected",
                    file_, v.name, v.type));
  }
  void check(fmi3Status status, const char* call) {
    if (status == fmi3OK || status == fmi3Warning) return;
    throw NumericalError(fmt::format("{}: {} returned {}: {}", file_, call,
                                     status == fmi3Discard ? "discard" : "an error",
                                     ear_.last_error));
  }

  std::string file_;
  Ear ear_;
  Fmi3Library fmu_;
  fmi3Instance instance_ = nullptr;
};

}  // namespace

std::unique_ptr<FmuSlave> loadFmi3(const FmuDescription& fmu, const std::string& folder,
                                   const std::string& instance_name,
                                   std::function<void(const std::string&)> say) {
  return std::make_unique<Fmi3Slave>(fmu, folder, instance_name, std::move(say));
}

std::unique_ptr<FmuSlave> loadFmu(const FmuDescription& fmu, const std::string& folder,
                                  const std::string& instance_name,
                                  std::function<void(const std::string&)> say) {
  if (!fmu.has_binary) {
    throw InputError(
        fmt::format("{}: has no {}, only code for other machines", fmu.file, fmu.binaryPath()));
  }
  return fmu.fmi_version == 2 ? loadFmi2(fmu, folder, instance_name, std::move(say))
                              : loadFmi3(fmu, folder, instance_name, std::move(say));
}

}  // namespace ballbot
