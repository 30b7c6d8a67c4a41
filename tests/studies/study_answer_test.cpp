#include "studies/study_answer.hpp"

#include <gmock/gmock.h>

namespace ballbot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Passed of four at 5, 10, 20 and 40.
StudyCurve curve(const std::string& name, const std::vector<int>& passed) {
  StudyCurve out;
  out.name = name;
  double value = 5;
  for (const int p : passed) {
    out.points.push_back({std::to_string(value), value, wilsonInterval(p, 4), {}});
    value *= 2;
  }
  return out;
}

class StudyAnswer : public ::testing::Test {
 protected:
  StudyAnswer() {
    along_.name = "bandwidth";
    along_.unit = "Hz";
    curves_.name = "shaping";
    view_.along = &along_;
    view_.curves = &curves_;
    view_.numeric = true;
  }
  void add(const std::string& panel, const std::vector<int>& none,
           const std::vector<int>& matched) {
    view_.panels.push_back({panel, {curve("none", none), curve("matched", matched)}});
  }
  Study study_;
  StudyAxis along_, curves_;
  StudyView view_;
};

TEST_F(StudyAnswer, SaysWhereEachCurveBeginsToPass) {
  add("delay 10 ms", {0, 0, 4, 4}, {0, 4, 4, 4});
  EXPECT_THAT(studyAnswer(study_, view_),
              ElementsAre("delay 10 ms, shaping none: along bandwidth, 50 % pass above 14.1 Hz "
                          "(95 %: 10 to 20 Hz); from 16 cases.",
                          "delay 10 ms, shaping matched: along bandwidth, 50 % pass above 7.07 Hz "
                          "(95 %: 5 to 10 Hz); from 16 cases."));
}

TEST_F(StudyAnswer, CasesThatDidNotRunCountNeitherWay) {
  CaseResult passed, lost;
  passed.outcome = CaseOutcome::kPassed;
  lost.outcome = CaseOutcome::kTimedOut;
  EXPECT_EQ(rateOf({&passed, &lost, &passed}).rate(), 1);
  EXPECT_EQ(rateOf({&lost}).count, 0);
  StudyCurve run{"", {}};
  for (const double value : {1.0, 2.0, 30.0}) {
    std::vector<const CaseResult*> results(2, value < 10 ? &passed : &lost);
    run.points.push_back({"", value, rateOf(results), results});
  }
  view_.curves = nullptr;
  view_.panels = {{"", {run}}};
  study_.name = "length";
  EXPECT_THAT(
      studyAnswer(study_, view_),
      ElementsAre("length: along bandwidth, at least 50 % pass everywhere in the range; from "
                  "4 cases, 2 more did not run."));
}

TEST_F(StudyAnswer, CountsADifferenceOnlyWhereItIsCertain) {
  add("delay 10 ms", {0, 0, 4, 4}, {0, 4, 4, 4});  // at 10: none of four against four of four
  add("delay 5 ms", {0, 2, 4, 4}, {0, 4, 4, 4});   // two of four may be luck
  add("delay 20 ms", {0, 0, 4, 4}, {0, 0, 0, 4});
  EXPECT_THAT(studyComparison(study_, view_),
              ElementsAre("shaping matched against none: passes with less bandwidth in 1 of 3 "
                          "comparisons, needs more in 1; in 1 no difference is certain (from 14.1 "
                          "to 7.07 Hz at delay 10 ms; from 14.1 to 28.3 Hz at delay 20 ms)."));
}

TEST_F(StudyAnswer, KnowsThatPassingEverywhereIsBetterThanNotDoingSo) {
  add("", {0, 0, 4, 4}, {4, 4, 4, 4});
  add("", {0, 0, 0, 0}, {0, 0, 4, 4});
  add("", {4, 4, 4, 4}, {4, 4, 4, 4});
  EXPECT_THAT(studyComparison(study_, view_).front(),
              HasSubstr("less bandwidth in 2 of 3 comparisons, needs more in 0; in 1 no"));
}

TEST_F(StudyAnswer, TurnsRoundWhereLessOfItPasses) {
  along_.name = "delay";
  along_.unit = "ms";
  add("", {4, 4, 0, 0}, {4, 4, 4, 0});
  EXPECT_THAT(studyComparison(study_, view_).front(),
              HasSubstr("passes with more delay in 1 of 1 comparisons, needs less in 0"));
}

TEST_F(StudyAnswer, ComparesNothingWhereNothingCrossesTheLevel) {
  add("", {4, 4, 4, 4}, {4, 4, 4, 4});
  EXPECT_THAT(studyComparison(study_, view_), IsEmpty());
}

/// Runs whose tilt is one of `tilts` each.
std::vector<CaseResult> runsWithTilt(const std::vector<double>& tilts) {
  std::vector<CaseResult> out;
  for (const double tilt : tilts) {
    out.push_back({});
    out.back().outcome = CaseOutcome::kPassed;
    out.back().metrics["largest_tilt_deg"] = tilt;
  }
  return out;
}

TEST_F(StudyAnswer, NamesTheStepThatChangesAMetricByMoreThanTheSeedsScatter) {
  study_.report.metrics = {"largest_tilt_deg"};
  view_.numeric = false;
  view_.curves = nullptr;
  const std::vector<CaseResult> ideal = runsWithTilt({5, 6, 7}), springs = runsWithTilt({6, 7, 8}),
                                noise = runsWithTilt({9, 10, 11});
  StudyCurve all;
  for (const auto& [label, runs] :
       {std::pair("ideal", &ideal), {"springs", &springs}, {"noise", &noise}}) {
    all.points.push_back({label, 0, {}, {}});
    for (const CaseResult& r : *runs) all.points.back().results.push_back(&r);
  }
  view_.panels = {{"", {all}}};
  EXPECT_THAT(
      studyMetrics(study_, view_),
      ElementsAre("largest_tilt_deg [deg]: median ideal 6, springs 7, noise 10; changed by more "
                  "than the seeds scatter at 'noise' (7 to 10)."));
}

TEST_F(StudyAnswer, SaysWhereAMetricIsLeastAndLargestAmongRunsThatStayedUp) {
  study_.report.metrics = {"largest_tilt_deg"};
  add("delay 10 ms", {4, 4, 4, 4}, {4, 4, 4, 4});
  const std::vector<CaseResult> few = runsWithTilt({2, 3, 4}), many = runsWithTilt({8, 9});
  std::vector<CaseResult> fallen = runsWithTilt({90});
  fallen.front().outcome = CaseOutcome::kFell;
  auto& curves = view_.panels.front().curves;
  for (const CaseResult& r : few) curves[0].points[1].results.push_back(&r);
  for (const CaseResult& r : many) curves[1].points[2].results.push_back(&r);
  curves[1].points[3].results.push_back(&fallen.front());
  curves[0].points[1].label = "10";
  curves[1].points[2].label = "20";
  EXPECT_THAT(
      studyMetrics(study_, view_),
      ElementsAre(
          "largest_tilt_deg [deg]: median from 3 (delay 10 ms, shaping none, bandwidth 10 Hz) "
          "to 8.5 (delay 10 ms, shaping matched, bandwidth 20 Hz)."));
}

TEST_F(StudyAnswer, HasNothingToCompareWithoutCurvesOrNumbers) {
  add("", {0, 0, 4, 4}, {4, 4, 4, 4});
  view_.numeric = false;
  EXPECT_THAT(studyComparison(study_, view_), IsEmpty());
  view_.numeric = true;
  view_.curves = nullptr;
  EXPECT_THAT(studyComparison(study_, view_), IsEmpty());
}

}  // namespace
}  // namespace ballbot
