#pragma once

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
};

}  // namespace ballbot
