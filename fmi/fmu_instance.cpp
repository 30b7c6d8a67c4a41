#include "fmi/fmu_instance.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/utf8.hpp"

namespace ballbot {
std::string logText(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8Length(text, i);
    if (length == 0) {
      out += '?';
      ++i;
      continue;
    }
    if (text[i] == '#') out += '#';
    out.append(text, i, length);
    i += length;
  }
  return out;
}

void FmuInstance::refuse(const char* function, const char* why) noexcept {
  fmu.fail();
  if (!errors_on_) return;
  try {
    log_(kLogErrors, logText(fmt::format("{}: {}", function, why)));
  } catch (...) {  // no memory for words
  }
}

void FmuInstance::note(const std::string& text) noexcept {
  if (!events_on_) return;
  try {
    log_(kLogEvents, logText(text));
  } catch (...) {
  }
}

void FmuInstance::setLogging(bool on, std::size_t count, const char* const* categories) {
  if (count > 0 && !categories) throw InputError("categories are counted but not given");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = categories[i] ? categories[i] : "";
    if (name != kLogErrors && name != kLogEvents) {
      throw InputError(fmt::format("there is no log category '{}', only {} and {}", name,
                                   kLogErrors, kLogEvents));
    }
  }
  if (count == 0) errors_on_ = events_on_ = on;
  for (std::size_t i = 0; i < count; ++i) {
    (std::strcmp(categories[i], kLogErrors) == 0 ? errors_on_ : events_on_) = on;
  }
  errors_on_ = errors_on_ || errors_always_;
}

const StateBlob& FmuInstance::held(const void* state) const {
  for (const auto& own : states_) {
    if (own.get() == state && state != nullptr) return *own;
  }
  throw InputError("this FMU state was not made by this instance, or is freed");
}

void FmuInstance::put(StateBlob blob, void** state) {
  if (!state) throw InputError("nowhere to put the FMU state");
  for (const auto& own : states_) {
    if (own.get() == *state) {
      *own = std::move(blob);
      return;
    }
  }
  if (*state) held(*state);  // throws: neither null nor ours
  states_.push_back(std::make_unique<StateBlob>(std::move(blob)));
  *state = states_.back().get();
}

void FmuInstance::getState(void** state) { put(fmu.saveState(), state); }

void FmuInstance::setState(void* state) { fmu.restoreState(held(state)); }

void FmuInstance::freeState(void** state) {
  if (!state || !*state) return;
  held(*state);
  states_.erase(std::find_if(states_.begin(), states_.end(),
                             [&](const auto& own) { return own.get() == *state; }));
  *state = nullptr;
}

void FmuInstance::serialize(void* state, void* bytes, std::size_t size) const {
  const StateBlob& blob = held(state);
  if (!bytes || size < blob.size()) {
    throw InputError(
        fmt::format("the state needs {} bytes, {} are given", blob.size(), bytes ? size : 0));
  }
  std::memcpy(bytes, blob.data(), blob.size());
}

void FmuInstance::deserialize(const void* bytes, std::size_t size, void** state) {
  if (!bytes) throw InputError("no serialized state is given");
  const auto* begin = static_cast<const std::uint8_t*>(bytes);
  StateBlob blob(begin, begin + size);
  fmu.checkState(blob);
  put(std::move(blob), state);
}

}  // namespace ballbot
