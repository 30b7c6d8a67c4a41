#include "experiment/verdict.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/nearest_word.hpp"

namespace ballbot {

std::vector<VerdictRow> judge(const std::vector<MetricLimit>& requirements,
                              const std::map<std::string, double>& metrics,
                              const std::vector<std::string>& known_metrics) {
  std::vector<VerdictRow> rows;
  for (const MetricLimit& r : requirements) {
    if (std::find(known_metrics.begin(), known_metrics.end(), r.metric) == known_metrics.end()) {
      const std::string near = nearestWord(r.metric, {known_metrics.begin(), known_metrics.end()});
      throw InputError(fmt::format(
          "{}: requirement on unknown metric '{}'{}", toText(r.where), r.metric,
          near.empty() ? fmt::format("; known are: {}", fmt::join(known_metrics, ", "))
                       : fmt::format("; did you mean '{}'? docs/metrics.md has them all", near)));
    }
    VerdictRow row;
    row.metric = r.metric;
    row.limit = r.below && r.above ? fmt::format("{} to {}", *r.above, *r.below)
                : r.below          ? fmt::format("< {}", *r.below)
                                   : fmt::format("> {}", *r.above);
    const auto it = metrics.find(r.metric);
    row.measured = it != metrics.end();
    if (row.measured) {
      row.value = it->second;
      row.passed = (!r.below || row.value < *r.below) && (!r.above || row.value > *r.above);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace ballbot
