#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/time.hpp"

namespace ballbot {

enum class SignalKind {
  kReal,    ///< continuous
  kCount,   ///< a whole number, below 2^53
  kNumber,  ///< a whole number, below 2^31
  kTime,    ///< whole nanoseconds inside, seconds outside
  kCode,    ///< one of a few states, from 0; its description names them
  kFlag,    ///< 0 or 1
};

/// Without a fraction in every format; times have one.
constexpr bool isWhole(SignalKind kind) {
  return kind != SignalKind::kReal && kind != SignalKind::kTime;
}

/// How many elements a signal has.
enum class SignalExtent {
  kFixed,        ///< as many for every robot
  kPerJoint,     ///< one for each actuator: wheels, then arm joints
  kPerArmJoint,  ///< one for each joint of the arm
};

/// One named quantity of a frame. The rows of a frame's table (model/signal_table.hpp) are the one
/// place where its quantities are listed: message definitions, conversions, columns of exported
/// logs, variables of the FMU and checks of what is received are made from them. All elements have
/// one unit, so a message field of several (q: metres and radians) is several rows.
template <typename Frame>
struct Signal {
  const char* message_field;  ///< field of the frame's .lcm type that carries it; may be empty
  const char* name;           ///< unique within the frame, and the same in every format
  SignalExtent extent;
  int size;
  SignalKind kind;
  const char* unit;         ///< SI; empty where there is none
  const char* elements;     ///< their names with a blank between each; empty: only one, or numbered
  const char* description;  ///< no more than a line
  double largest;           ///< what a number of its kind cannot exceed, see largestOf()

  const double* (*reals)(const Frame&);  ///< the elements, side by side; null unless kReal
  double* (*reals_of)(Frame&);
  std::int64_t (*whole)(const Frame&);  ///< the value, times in nanoseconds; null if kReal
  void (*set_whole)(Frame&, std::int64_t);

  /// All elements as doubles, in order, without loss of a bit; times in seconds.
  void read(const Frame& from, double* to) const;
  void write(Frame& to, const double* from) const;
};

/// What no number of a unit exceeds: far more than any robot reaches, even one that falls or rolls
/// for a day, and far less than where arithmetic breaks down.
double largestOf(SignalKind kind, const std::string& unit);

/// As in tables: "joint_torque_wheel2", "p_WE_x", "door_angle".
std::string columnName(const char* signal, const char* elements, int size, int element);
template <typename Frame>
std::string columnName(const Signal<Frame>& signal, int element) {
  return columnName(signal.name, signal.elements, signal.size, element);
}

/// A frame as a row of numbers, in the order of its signals. Its time is not in it.
template <typename Frame>
std::size_t rowSize(const std::vector<Signal<Frame>>& signals) {
  std::size_t size = 0;
  for (const auto& signal : signals) size += static_cast<std::size_t>(signal.size);
  return size;
}
template <typename Frame>
void readSignals(const std::vector<Signal<Frame>>& signals, const Frame& from, double* to) {
  for (const auto& signal : signals) {
    signal.read(from, to);
    to += signal.size;
  }
}
template <typename Frame>
void writeSignals(const std::vector<Signal<Frame>>& signals, const double* from, Frame& to) {
  for (const auto& signal : signals) {
    signal.write(to, from);
    from += signal.size;
  }
}

double toSignal(SignalKind kind, std::int64_t whole);
std::int64_t fromSignal(SignalKind kind, double value);

template <typename Frame>
void Signal<Frame>::read(const Frame& from, double* to) const {
  if (reals == nullptr) {
    *to = toSignal(kind, whole(from));
    return;
  }
  const double* values = reals(from);
  for (int i = 0; i < size; ++i) to[i] = values[i];
}

template <typename Frame>
void Signal<Frame>::write(Frame& to, const double* from) const {
  if (reals == nullptr) return set_whole(to, fromSignal(kind, *from));
  double* values = reals_of(to);
  for (int i = 0; i < size; ++i) values[i] = from[i];
}

}  // namespace ballbot
