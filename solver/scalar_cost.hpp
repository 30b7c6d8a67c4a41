#pragma once

#include <algorithm>
#include <array>

namespace ballbot {

/// A cost of one term: the Cost (cost_contract.hpp) of problems that want no split.
struct ScalarCost {
  static constexpr int kCount = 1;
  std::array<double, kCount> value{};
  double violation = 0;

  void add(double cost) { value[0] += cost; }
  /// For an inequality h >= 0.
  void require(double h) { violation = std::max(violation, -h); }

  double total() const { return value[0]; }
  ScalarCost& operator+=(const ScalarCost& other) {
    value[0] += other.value[0];
    violation = std::max(violation, other.violation);
    return *this;
  }
};

}  // namespace ballbot
