#include "studies/case_check.hpp"

#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "experiment/scenario_variants.hpp"

namespace ballbot {
namespace {

/// What the study itself says of metrics, held against those that its runs can have.
void checkMetricNames(const Study& study, const std::set<std::string>& known) {
  for (const std::string& name : study.report.metrics) {
    if (known.count(name) > 0) continue;
    throw InputError(fmt::format("{}: report.metrics names '{}', which no run has; there are: {}",
                                 toText(study.tree.where()), name, fmt::join(known, ", ")));
  }
  for (const StudyAxis& axis : study.axes) {
    if (known.count(axis.name) == 0) continue;
    throw InputError(
        fmt::format("{}: an axis is called '{}', as a metric of the runs; give it another name",
                    toText(study.tree.where()), axis.name));
  }
}

}  // namespace

void checkCases(const Study& study, const ConfigNode& scenario_tree,
                const std::vector<StudyCase>& cases) {
  struct Trouble {
    std::string first;  ///< case that has it
    int count = 0;
  };
  std::map<std::string, Trouble> troubles;
  std::vector<std::string> order;
  std::set<std::vector<std::string>> seen;
  std::size_t wrong = 0;
  std::set<std::string> known_metrics;
  for (const StudyCase& c : cases) {
    if (!seen.insert(c.overrides).second) continue;  // another seed changes nothing here
    try {
      const auto metrics = checkScenario(readScenario(scenario_tree, c.overrides, c.seed));
      known_metrics.insert(metrics.begin(), metrics.end());
    } catch (const InputError& e) {
      ++wrong;
      Trouble& trouble = troubles[e.what()];
      if (trouble.count++ == 0) {
        trouble.first = c.describe(study);
        order.push_back(e.what());
      }
    }
  }
  if (wrong == 0) {
    checkMetricNames(study, known_metrics);
    return;
  }
  std::string text =
      fmt::format("{}: {} of {} configurations cannot run; nothing was started:", study.name, wrong,
                  seen.size());
  for (const std::string& what : order) {
    const Trouble& trouble = troubles[what];
    text += fmt::format("\n  {}\n    in: {}", what, trouble.first);
    if (trouble.count > 1) text += fmt::format(" and {} more", trouble.count - 1);
  }
  throw InputError(text);
}

}  // namespace ballbot
