#include <cmath>
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

/// 2^53: above it doubles skip whole numbers.
constexpr double kLargestExact = 9007199254740992.0;

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

  std::string name() const override { return file_; }

  void enterInitializationMode(SimTime start) override {
    check(fmu_.fmi3EnterInitializationMode(instance_, false, 0, secondsOf(start), false, 0),
          "fmi3EnterInitializationMode");
  }
  void exitInitializationMode() override {
    check(fmu_.fmi3ExitInitializationMode(instance_), "fmi3ExitInitializationMode");
  }
  void doStep(SimTime now, SimDuration step) override {
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
      getOne(v, values);
      values += v.size;
    }
  }
  void set(const FmuPort& port, const double* values) override {
    for (const ImportedVariable& v : port.variables) {
      for (int i = 0; i < v.size; ++i) requireTaken(v, values[i]);
      setOne(v, values);
      values += v.size;
    }
  }

  StateBlob saveState() const override {
    fmi3FMUState state = nullptr;
    check(fmu_.fmi3GetFMUState(instance_, &state), "fmi3GetFMUState");
    std::size_t size = 0;
    check(fmu_.fmi3SerializedFMUStateSize(instance_, state, &size), "fmi3SerializedFMUStateSize");
    StateBlob blob(size);
    check(fmu_.fmi3SerializeFMUState(instance_, state, blob.data(), size), "fmi3SerializeFMUState");
    check(fmu_.fmi3FreeFMUState(instance_, &state), "fmi3FreeFMUState");
    return blob;
  }
  void restoreState(const StateBlob& blob) override {
    fmi3FMUState state = nullptr;
    check(fmu_.fmi3DeserializeFMUState(instance_, blob.data(), blob.size(), &state),
          "fmi3DeserializeFMUState");
    const fmi3Status status = fmu_.fmi3SetFMUState(instance_, state);
    fmu_.fmi3FreeFMUState(instance_, &state);
    check(status, "fmi3SetFMUState");
  }

 private:
  void getOne(const ImportedVariable& v, double* values) {
    switch (v.facts->native) {
      case NativeType::kFloat32:
        return fetch(fmu_.fmi3GetFloat32, "fmi3GetFloat32", v, values);
      case NativeType::kFloat64:
        return fetch(fmu_.fmi3GetFloat64, "fmi3GetFloat64", v, values);
      case NativeType::kInt8:
        return fetch(fmu_.fmi3GetInt8, "fmi3GetInt8", v, values);
      case NativeType::kUInt8:
        return fetch(fmu_.fmi3GetUInt8, "fmi3GetUInt8", v, values);
      case NativeType::kInt16:
        return fetch(fmu_.fmi3GetInt16, "fmi3GetInt16", v, values);
      case NativeType::kUInt16:
        return fetch(fmu_.fmi3GetUInt16, "fmi3GetUInt16", v, values);
      case NativeType::kInt32:
        return fetch(fmu_.fmi3GetInt32, "fmi3GetInt32", v, values);
      case NativeType::kUInt32:
        return fetch(fmu_.fmi3GetUInt32, "fmi3GetUInt32", v, values);
      case NativeType::kInt64:
        return fetch(fmu_.fmi3GetInt64, "fmi3GetInt64", v, values);
      case NativeType::kUInt64:
        return fetch(fmu_.fmi3GetUInt64, "fmi3GetUInt64", v, values);
      case NativeType::kBoolean:
        return fetch(fmu_.fmi3GetBoolean, "fmi3GetBoolean", v, values);
      case NativeType::kNone:
        refuse(v);
    }
  }
  void setOne(const ImportedVariable& v, const double* values) {
    switch (v.facts->native) {
      case NativeType::kFloat32:
        return give(fmu_.fmi3SetFloat32, "fmi3SetFloat32", v, values);
      case NativeType::kFloat64:
        return give(fmu_.fmi3SetFloat64, "fmi3SetFloat64", v, values);
      case NativeType::kInt8:
        return give(fmu_.fmi3SetInt8, "fmi3SetInt8", v, values);
      case NativeType::kUInt8:
        return give(fmu_.fmi3SetUInt8, "fmi3SetUInt8", v, values);
      case NativeType::kInt16:
        return give(fmu_.fmi3SetInt16, "fmi3SetInt16", v, values);
      case NativeType::kUInt16:
        return give(fmu_.fmi3SetUInt16, "fmi3SetUInt16", v, values);
      case NativeType::kInt32:
        return give(fmu_.fmi3SetInt32, "fmi3SetInt32", v, values);
      case NativeType::kUInt32:
        return give(fmu_.fmi3SetUInt32, "fmi3SetUInt32", v, values);
      case NativeType::kInt64:
        return give(fmu_.fmi3SetInt64, "fmi3SetInt64", v, values);
      case NativeType::kUInt64:
        return give(fmu_.fmi3SetUInt64, "fmi3SetUInt64", v, values);
      case NativeType::kBoolean:
        return give(fmu_.fmi3SetBoolean, "fmi3SetBoolean", v, values);
      case NativeType::kNone:
        refuse(v);
    }
  }
  template <typename T>
  using Getter = fmi3Status (*)(fmi3Instance, const fmi3ValueReference[], std::size_t, T[],
                                std::size_t);
  template <typename T>
  using Setter = fmi3Status (*)(fmi3Instance, const fmi3ValueReference[], std::size_t, const T[],
                                std::size_t);
  template <typename T>
  void fetch(Getter<T> function, const char* name, const ImportedVariable& v, double* values) {
    const auto n = static_cast<std::size_t>(v.size);
    const std::unique_ptr<T[]> row(new T[n]());
    check(function(instance_, &v.reference, 1, row.get(), n), name);
    for (std::size_t i = 0; i < n; ++i) {
      values[i] = static_cast<double>(row[i]);
      if (v.facts->kind == ValueKind::kInteger && std::abs(values[i]) > kLargestExact) {
        throw NumericalError(fmt::format(
            "{}: '{}' is {}, beyond the whole numbers that a connection carries exactly", file_,
            v.name, row[i]));
      }
    }
  }
  template <typename T>
  void give(Setter<T> function, const char* name, const ImportedVariable& v, const double* values) {
    const auto n = static_cast<std::size_t>(v.size);
    const std::unique_ptr<T[]> row(new T[n]());
    for (std::size_t i = 0; i < n; ++i) row[i] = static_cast<T>(values[i]);
    check(function(instance_, &v.reference, 1, row.get(), n), name);
  }
  void requireTaken(const ImportedVariable& v, double value) const {
    const std::string refusal = refusalOf(v, value);
    if (refusal.empty()) return;
    throw NumericalError(
        fmt::format("{}: '{}' would be set to {}; it {}", file_, v.name, value, refusal));
  }
  [[noreturn]] void refuse(const ImportedVariable& v) const {
    throw InputError(
        fmt::format("{}: '{}' is of type {}; numbers, booleans and enumerations can be "
                    "connected",
                    file_, v.name, v.type));
  }
  void check(fmi3Status status, const char* call) const {
    if (status == fmi3OK || status == fmi3Warning) return;
    fmu_.library.require({call});  // says so if that is why
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
