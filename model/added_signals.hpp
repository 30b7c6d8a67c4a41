#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace ballbot {

/// A quantity that somebody added to a frame, beside those of model/signal_table.hpp.
struct AddedSignal {
  std::string name;   ///< unique beside the frame's own, and the same in every format
  std::string unit;   ///< SI; empty where there is none
  std::string words;  ///< no more than a line
};

/// So many at most: they have to fit into one packet beside the frame.
constexpr std::size_t kMaxAddedSignals = 48;

/// Added quantities with their values at the current time. The list stays as it is during a run.
struct AddedSignals {
  std::vector<AddedSignal> list;
  std::vector<double> values;  ///< one for each of the list

  bool empty() const { return list.empty(); }
  static const AddedSignals& none() {
    static const AddedSignals nothing;
    return nothing;
  }
};

/// The frames to which values can be added, in the order in which they come to be within an event.
enum class AddedTo : std::size_t { kSensors, kTruth, kEstimate, kPlan };
constexpr std::array<AddedTo, 4> kAllAddedTo = {AddedTo::kSensors, AddedTo::kTruth,
                                                AddedTo::kEstimate, AddedTo::kPlan};

/// One of each.
template <typename T>
struct PerAddedTo {
  std::array<T, kAllAddedTo.size()> of{};

  T& operator[](AddedTo frame) { return of[static_cast<std::size_t>(frame)]; }
  const T& operator[](AddedTo frame) const { return of[static_cast<std::size_t>(frame)]; }
};

}  // namespace ballbot
