#pragma once

#include <algorithm>
#include <vector>

namespace ballbot {

/// Neighbours of time t in a list of samples ordered by their member `time`, and the share of the
/// later one; the first or the last sample alone where t lies outside.
template <typename Sample>
struct BetweenSamples {
  const Sample *before, *after;
  double share;

  BetweenSamples(const std::vector<Sample>& samples, double t) {
    const auto later =
        std::upper_bound(samples.begin(), samples.end(), t,
                         [](double value, const Sample& s) { return value < s.time; });
    if (later == samples.begin() || later == samples.end()) {
      before = after = later == samples.begin() ? &samples.front() : &samples.back();
      share = 0;
    } else {
      after = &*later;
      before = after - 1;
      share = (t - before->time) / (after->time - before->time);
    }
  }
  /// A member, interpolated linearly.
  template <typename T>
  T of(T Sample::*member) const {
    return before->*member + share * (after->*member - before->*member);
  }
};

}  // namespace ballbot
