#include "experiment/loop_margins.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/config_reader.hpp"

namespace ballbot {
namespace {

constexpr double kStep = 1.2;  ///< of the search, in delay and in gain
constexpr double kLongest_s = 1;
constexpr double kLargestGain = 1000;
constexpr double kGainTolerance = 1e-3;  // relative

/// Where a rate that is negative at `low` and is not at `high` crosses zero, between two
/// neighbours.
double crossing(double low, double rate_low, double high, double rate_high) {
  return low + (high - low) * rate_low / (rate_low - rate_high);
}

/// @param growth  rate at a whole number of ticks; negative at none
double criticalTicks(const std::function<double(int)>& growth, double rate_at_none, int most) {
  int low = 0;
  double rate_low = rate_at_none;
  while (low < most) {
    int high = std::min(most, std::max(low + 1, static_cast<int>(std::ceil(kStep * low))));
    double rate_high = growth(high);
    if (rate_high >= 0) {
      while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        const double rate = growth(middle);
        (rate < 0 ? low : high) = middle;
        (rate < 0 ? rate_low : rate_high) = rate;
      }
      return crossing(low, rate_low, high, rate_high);
    }
    low = high;
    rate_low = rate_high;
  }
  return kInf;
}

/// @param step  factor of the search, above 1 or below
/// @return infinity or 0 where there is none
double criticalGain(const std::function<double(double)>& growth, double rate_at_one, double step) {
  double stable = 1, rate_stable = rate_at_one;
  for (;;) {
    double other = stable * step, rate_other = growth(other);
    if (rate_other >= 0) {
      while (std::abs(other / stable - 1) > kGainTolerance) {
        const double middle = std::sqrt(stable * other), rate = growth(middle);
        (rate < 0 ? stable : other) = middle;
        (rate < 0 ? rate_stable : rate_other) = rate;
      }
      return crossing(stable, rate_stable, other, rate_other);
    }
    stable = other;
    rate_stable = rate_other;
    if (stable > kLargestGain) return kInf;
    if (stable < 1 / kLargestGain) return 0;
  }
}

}  // namespace

SampledMargins marginsOf(const SampledLoop& loop) {
  SampledMargins out;
  out.growth_rate = loop.growthRate({});
  out.stable = out.growth_rate < 0;
  if (!out.stable) return out;
  const double tick = toSeconds(loop.drivePeriod());
  const int most = static_cast<int>(kLongest_s / tick);
  out.delay_margin = tick * criticalTicks(
                                [&](int n) {
                                  return loop.growthRate({1, 0, n});
                                },
                                out.growth_rate, most);
  out.wheel_delay_margin = tick * criticalTicks(
                                      [&](int n) {
                                        return loop.growthRate({1, n, 0});
                                      },
                                      out.growth_rate, most);
  const auto with_gain = [&](double gain) { return loop.growthRate({gain, 0, 0}); };
  out.wheel_gain_high = criticalGain(with_gain, out.growth_rate, kStep);
  out.wheel_gain_low = criticalGain(with_gain, out.growth_rate, 1 / kStep);
  return out;
}

}  // namespace ballbot
