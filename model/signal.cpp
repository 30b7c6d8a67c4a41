#include "model/signal.hpp"

#include <cmath>
#include <sstream>

namespace ballbot {

double largestOf(SignalKind kind, const std::string& unit) {
  if (kind == SignalKind::kCount) return 1e12;
  if (kind == SignalKind::kNumber) return 1e9;
  if (kind == SignalKind::kFlag) return 1;
  if (unit == "rad" || unit == "m" || unit.empty()) return 1e6;
  if (unit == "rad/s" || unit == "m/s" || unit == "N m") return 1e5;
  if (unit == "m/s^2") return 1e6;
  return 1e7;
}

std::string columnName(const char* signal, const char* elements, int size, int element) {
  if (size == 1 && *elements == '\0') return signal;
  std::istringstream names(elements);
  std::string name;
  for (int i = 0; i <= element; ++i) names >> name;
  if (name.empty()) name = std::to_string(element + 1);
  return std::string(signal) + "_" + name;
}

double toSignal(SignalKind kind, std::int64_t whole) {
  return kind == SignalKind::kTime ? static_cast<double>(whole) / 1e9 : static_cast<double>(whole);
}

std::int64_t fromSignal(SignalKind kind, double value) {
  return kind == SignalKind::kTime ? std::llround(1e9 * value) : static_cast<std::int64_t>(value);
}

}  // namespace ballbot
