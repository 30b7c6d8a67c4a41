#include "studies/case_check.hpp"

#include <map>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiment/scenario_variants.hpp"

namespace ballbot {

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
  for (const StudyCase& c : cases) {
    if (!seen.insert(c.overrides).second) continue;  // another seed changes nothing here
    try {
      checkScenario(readScenario(scenario_tree, c.overrides, c.seed));
    } catch (const InputError& e) {
      ++wrong;
      Trouble& trouble = troubles[e.what()];
      if (trouble.count++ == 0) {
        trouble.first = c.describe(study);
        order.push_back(e.what());
      }
    }
  }
  if (wrong == 0) return;
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
