#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fmi/plant_fmu.hpp"

namespace ballbot {

/// Log categories of the model description.
constexpr const char* kLogErrors = "logStatusError";
constexpr const char* kLogEvents = "logEvents";

/// Text for an importer's log: valid UTF-8, and '#' doubled, which FMI reads as a reference to a
/// variable. Bytes that are no UTF-8 become '?'.
std::string logText(const std::string& text);

/// One instance as both C interfaces have it: the plant, its log and the states it handed out.
/// Exceptions end here: every C function goes through attempt().
class FmuInstance {
 public:
  /// Called with a category and text; text is safe to hand on.
  using Log = std::function<void(const char* category, const std::string& text)>;

  /// @throw Error as PlantFmu.
  FmuInstance(const std::string& resources, const std::string& token, int fmi_version, Log log)
      : fmu(resources, token, fmi_version),
        log_(std::move(log)),
        errors_always_(fmi_version == 2) {}

  /// Runs `work`. If it throws, says why in the log, puts the FMU into its error state and returns
  /// false.
  template <typename Work>
  bool attempt(const char* function, Work&& work) noexcept {
    try {
      work();
      return true;
    } catch (const std::exception& e) {
      refuse(function, e.what());
    } catch (...) {
      refuse(function, "unknown error");
    }
    return false;
  }
  void refuse(const char* function, const char* why) noexcept;
  void note(const std::string& text) noexcept;
  /// Switches categories; none given means all. FMI 3 lets an importer silence errors, too; in FMI
  /// 2 the switch is about debugging only. @throw InputError for an unknown category.
  void setLogging(bool on, std::size_t count, const char* const* categories);

  // States that the importer holds by pointer. A pointer that is not one of ours is refused.
  void getState(void** state);
  void setState(void* state);
  void freeState(void** state);
  std::size_t stateSize(void* state) const { return held(state).size(); }
  void serialize(void* state, void* bytes, std::size_t size) const;
  void deserialize(const void* bytes, std::size_t size, void** state);

  PlantFmu fmu;

 private:
  const StateBlob& held(const void* state) const;
  void put(StateBlob blob, void** state);

  Log log_;
  bool errors_always_, errors_on_ = true, events_on_ = false;
  std::vector<std::unique_ptr<StateBlob>> states_;
};

}  // namespace ballbot
