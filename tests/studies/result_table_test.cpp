#include "studies/result_table.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "studies/study_view.hpp"
#include "tests/studies/support_study.hpp"

namespace ballbot {
namespace {

Study bandwidthStudy() {
  return studyOf(
      "axes:\n"
      "  - {name: shaping, options: [{label: none, set: {s: 0}}, {label: matched, set: {s: 1}}]}\n"
      "  - {name: bandwidth, unit: Hz, paths: [b], values: [5, 10, 20]}\n"
      "seeds: 10\n");
}

/// Passes from 20 Hz on without, from 10 Hz on with shaping.
std::map<std::string, CaseResult> resultsOf(const std::vector<StudyCase>& cases) {
  std::map<std::string, CaseResult> out;
  for (const StudyCase& c : cases) {
    CaseResult r;
    r.id = c.id;
    const bool passes = c.point[1].number >= (c.point[0].label == "none" ? 20 : 10);
    r.outcome = passes ? CaseOutcome::kPassed : CaseOutcome::kFell;
    r.reason = passes ? "" : "fell at 2.5 s, \"again\"";
    r.simulated_s = passes ? 5 : 2.5;
    r.metrics["largest_tilt_deg"] = 0.1 * static_cast<double>(c.seed);
    if (!passes) r.metrics["time_of_fall_s"] = 2.5;
    r.trajectory_digest = "d" + c.id;
    r.cpu_s = static_cast<double>(c.seed);
    out[c.id] = r;
  }
  return out;
}

TEST(CaseResult, ReadsBackWhole) {
  CaseResult r;
  r.id = "0123";
  r.outcome = CaseOutcome::kTimedOut;
  r.reason = "quotes \" and\nlines";
  r.metrics["a_m"] = 0.1 + 0.2;
  r.simulated_s = 1e-3;
  const CaseResult again = CaseResult::fromJson(r.toJson());
  EXPECT_EQ(again.toJson(), r.toJson());
  EXPECT_EQ(again.metrics.at("a_m"), 0.1 + 0.2);
  EXPECT_EQ(again.outcome, CaseOutcome::kTimedOut);
  EXPECT_EQ(r.toJson().find('\n'), std::string::npos) << "one record is one line";
  EXPECT_THROW(CaseResult::fromJson("{\"case\": 1}"), InputError);
}

TEST(ResultTable, HoldsOneRowACaseWithUnits) {
  const Study study = bandwidthStudy();
  const auto cases = generateCases(study);
  const ResultTable table = makeResultTable(study, cases, resultsOf(cases));
  EXPECT_EQ(table.rows, 60u);
  const std::string csv = table.csv();
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "case,seed,shaping,bandwidth [Hz],outcome,reason,simulated_s [s],largest_tilt_deg "
            "[deg],time_of_fall_s [s],trajectory_digest");
  EXPECT_NE(csv.find(",none,5,fell,\"fell at 2.5 s, \"\"again\"\"\",2.5,0.1,2.5,"),
            std::string::npos);
  EXPECT_NE(csv.find(",none,20,passed,,5,0.1,,"), std::string::npos)
      << "a missing number is an empty cell";
}

TEST(ResultTable, IsTheSameWhateverTheOrderInWhichResultsCame) {
  const Study study = bandwidthStudy();
  const auto cases = generateCases(study);
  const auto results = resultsOf(cases);
  auto late = results;
  for (auto& [id, r] : late) r.cpu_s *= 3;  // a fact of the machine
  EXPECT_EQ(makeResultTable(study, cases, late).digest(),
            makeResultTable(study, cases, results).digest());
  late.begin()->second.metrics["largest_tilt_deg"] += 1e-15;
  EXPECT_NE(makeResultTable(study, cases, late).digest(),
            makeResultTable(study, cases, results).digest());
}

TEST(StudyView, FindsTheBoundaryOfEachCurve) {
  const Study study = bandwidthStudy();
  const auto cases = generateCases(study);
  const auto results = resultsOf(cases);
  const StudyView view = arrange(study, cases, results);
  ASSERT_NE(view.along, nullptr);
  EXPECT_EQ(view.along->name, "bandwidth");
  EXPECT_EQ(view.curves->name, "shaping");
  ASSERT_EQ(view.panels.size(), 1u);
  const Boundary none = view.panels[0].curves[0].boundary(0.5),
                 matched = view.panels[0].curves[1].boundary(0.5);
  EXPECT_NEAR(none.estimate, std::sqrt(10. * 20), 1e-9);
  EXPECT_NEAR(matched.estimate, std::sqrt(5. * 10), 1e-9);
  EXPECT_EQ(*none.low, 10);
  EXPECT_EQ(*none.high, 20);
}

}  // namespace
}  // namespace ballbot
