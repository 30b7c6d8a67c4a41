#include "report/sample_selection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ballbot {

namespace {

/// Adds the indices of what a plot of values[begin, end) must not lose.
void addExtremes(const std::vector<double>& values, std::size_t begin, std::size_t end,
                 std::vector<std::size_t>& kept) {
  const std::size_t none = end;
  std::size_t lowest = none, highest = none, gap = none;
  for (std::size_t i = begin; i < end; ++i) {
    if (!std::isfinite(values[i])) {
      if (gap == none) gap = i;
      continue;
    }
    if (lowest == none || values[i] < values[lowest]) lowest = i;
    if (highest == none || values[i] > values[highest]) highest = i;
  }
  for (const std::size_t i : {lowest, highest, gap}) {
    if (i != none) kept.push_back(i);
  }
}

}  // namespace

std::vector<std::size_t> selectExtremes(const std::vector<const std::vector<double>*>& columns,
                                        std::size_t wanted) {
  const std::size_t count = columns.front()->size();
  std::vector<std::size_t> kept;
  if (count <= wanted) {
    kept.resize(count);
    std::iota(kept.begin(), kept.end(), std::size_t{0});
    return kept;
  }
  const std::size_t stretches = std::max<std::size_t>(1, wanted / (2 * columns.size()));
  kept.push_back(0);
  kept.push_back(count - 1);
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t begin = s * count / stretches;
    const std::size_t end = (s + 1) * count / stretches;
    for (const auto* values : columns) addExtremes(*values, begin, end, kept);
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

std::vector<std::size_t> selectSpaced(const std::vector<double>& t, double spacing_s) {
  // Times are whole nanoseconds rounded to doubles: a sample due exactly now must not be missed.
  constexpr double kRounding_s = 1e-9;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const bool due = kept.empty() || t[i] - t[kept.back()] >= spacing_s - kRounding_s;
    if (due || i + 1 == t.size()) kept.push_back(i);
  }
  return kept;
}

}  // namespace ballbot
