#include "studies/study_engine.hpp"

#include <algorithm>

namespace ballbot {

StudyEngine::StudyEngine(const Study& study, const StudyFolder& folder, CaseLauncher& launcher,
                         std::function<void(std::size_t, std::size_t)> progress)
    : study_(study),
      launcher_(launcher),
      progress_(std::move(progress)),
      results_(folder.results()) {}

void StudyEngine::run(const std::vector<StudyCase>& cases) {
  std::vector<StudyCase> missing;
  for (const StudyCase& c : cases) {
    if (known_.emplace(c.id, cases_.size()).second) cases_.push_back(c);
    if (results_.find(c.id) == results_.end()) missing.push_back(c);
  }
  std::size_t done = 0;
  if (progress_) progress_(0, missing.size());
  if (missing.empty()) return;
  launcher_.launch(missing, [&](const CaseResult& result) {
    results_[result.id] = result;
    ++ran_now_;
    cpu_now_s_ += result.cpu_s;
    if (progress_) progress_(++done, missing.size());
  });
}

int StudyEngine::count(CaseOutcome outcome) const {
  return static_cast<int>(std::count_if(cases_.begin(), cases_.end(), [&](const StudyCase& c) {
    const auto it = results_.find(c.id);
    return it != results_.end() && it->second.outcome == outcome;
  }));
}

}  // namespace ballbot
