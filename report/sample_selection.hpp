#pragma once

#include <cstddef>
#include <vector>

namespace ballbot {

/// Which samples of columns over a common time to keep so that a plot of them looks the same.
/// The samples are cut into equal stretches; of each, every column's smallest and largest value
/// and the first gap (a value that is not finite) stay, and so do the first and the last sample.
/// @param columns  at least one, all of one length
/// @return ascending indices, all of them if there are at most `wanted`; else about `wanted`
std::vector<std::size_t> selectExtremes(const std::vector<const std::vector<double>*>& columns,
                                        std::size_t wanted);

/// Which samples to keep so that they lie at least `spacing_s` apart; the first and last stay.
std::vector<std::size_t> selectSpaced(const std::vector<double>& t, double spacing_s);

/// The values at `indices`.
template <typename T>
std::vector<T> selected(const std::vector<T>& values, const std::vector<std::size_t>& indices) {
  std::vector<T> out;
  out.reserve(indices.size());
  for (const std::size_t i : indices) out.push_back(values[i]);
  return out;
}

}  // namespace ballbot
