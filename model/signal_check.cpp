#include "model/signal_check.hpp"

#include <cmath>

#include <fmt/format.h>

#include "model/signal_table.hpp"

namespace ballbot {
namespace {

// A bench that skips periods counts time by its own cycles, a little ahead of the master.
constexpr SimDuration kMostAhead{100'000'000};

std::string isAhead(const char* what, SimTime time, SimTime now) {
  if (time <= now + kMostAhead) return {};
  return fmt::format("{} is {}, at {}", what, toText(time), toText(now));
}

template <typename Frame>
std::string beyond(const Signal<Frame>& signal, int element, double value, double largest) {
  const std::string name = columnName(signal, element);
  if (!std::isfinite(value)) return fmt::format("{} is {}", name, value);
  const char* space = *signal.unit == '\0' ? "" : " ";
  return fmt::format("{} is {}{}{}, beyond {:g}", name, value, space, signal.unit, largest);
}

/// The first element of a frame whose magnitude is above its bound, or that is not a number.
template <typename Frame>
std::string firstBeyond(const Signal<Frame>& signal, const Frame& frame, double largest) {
  const double* values = signal.reals(frame);
  for (int i = 0; i < signal.size; ++i) {
    if (!(std::abs(values[i]) <= largest)) return beyond(signal, i, values[i], largest);
  }
  return {};
}

template <typename Frame>
std::string firstImpossibleIn(const Frame& frame, SimTime now) {
  std::string text = isAhead("time", frame.time, now);
  for (const Signal<Frame>& signal : signalsOf(frame)) {
    if (!text.empty()) return text;
    if (signal.kind == SignalKind::kReal) {
      text = firstBeyond(signal, frame, signal.largest);
    } else if (signal.kind == SignalKind::kTime) {
      text = isAhead(signal.name, simTimeFromNs(signal.whole(frame)), now);
    } else if (const std::int64_t n = signal.whole(frame);
               n < 0 || static_cast<double>(n) > signal.largest) {
      text = fmt::format("{} is {}, must be 0 to {:.0f}", signal.name, n, signal.largest);
    }
  }
  return text;
}

std::string named(const char* frame, const std::string& text) {
  return text.empty() ? text : frame + text;
}

}  // namespace

std::string firstNonFinite(const ActuatorCommand& command) {
  for (const auto& signal : commandSignals()) {
    const double* values = signal.reals(command);
    for (int i = 0; i < signal.size; ++i) {
      if (!std::isfinite(values[i])) return beyond(signal, i, values[i], 0);
    }
  }
  return {};
}

std::string firstNonFinite(const AddedSignals& signals) {
  for (std::size_t i = 0; i < signals.values.size(); ++i) {
    if (std::isfinite(signals.values[i])) continue;
    return fmt::format("{} is {}", signals.list[i].name, signals.values[i]);
  }
  return {};
}

std::string firstImpossible(const SensorFrame& f, SimTime now) {
  return named("sensors.", firstImpossibleIn(f, now));
}
std::string firstImpossible(const TruthFrame& f, SimTime now) {
  return named("truth.", firstImpossibleIn(f, now));
}

}  // namespace ballbot
