#include "fmi/fmu_instance.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

/// Length of the UTF-8 sequence at `at`, or 0 if there is none.
std::size_t sequenceLength(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned lead = byte(at);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 && lead < 0xF5   ? 4
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xC2 && lead < 0xE0 ? 2
                                                           : 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  }
  // Overlong forms and surrogates.
  if ((lead == 0xE0 && byte(at + 1) < 0xA0) || (lead == 0xED && byte(at + 1) > 0x9F) ||
      (lead == 0xF0 && byte(at + 1) < 0x90) || (lead == 0xF4 && byte(at + 1) > 0x8F)) {
    return 0;
  }
  return length;
}

}  // namespace

std::string logText(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequenceLength(text, i);
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
