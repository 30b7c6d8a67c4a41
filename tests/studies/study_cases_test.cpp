#include "studies/study_cases.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "studies/setting_text.hpp"
#include "tests/studies/support_study.hpp"

namespace ballbot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const char kTwoAxes[] =
    "set: {duration_s: 2}\n"
    "axes:\n"
    "  - {name: bandwidth, unit: Hz, paths: [a.b, {path: a.k, times: 0.5, power: 2}], values: [5, "
    "10]}\n"
    "  - name: shaping\n"
    "    options:\n"
    "      - {label: none, set: {c.shape: {enabled: false}}}\n"
    "      - {label: matched, set: {c.shape: {fa: {from: bandwidth, times: 2}}}}\n"
    "seeds: [3, 8]\n";

TEST(StudyCases, AreAllCombinationsInTheOrderOfTheFile) {
  const Study study = studyOf(kTwoAxes);
  const std::vector<StudyCase> cases = generateCases(study);
  ASSERT_EQ(cases.size(), 8u);
  EXPECT_EQ(cases[0].describe(study), "bandwidth 5 Hz, shaping none, seed 3");
  EXPECT_EQ(cases[1].describe(study), "bandwidth 5 Hz, shaping none, seed 8");
  EXPECT_EQ(cases[2].describe(study), "bandwidth 5 Hz, shaping matched, seed 3");
  EXPECT_EQ(cases[7].describe(study), "bandwidth 10 Hz, shaping matched, seed 8");
}

TEST(StudyCases, LinkedPathsAndExpressionsFollowTheirAxis) {
  const std::vector<StudyCase> cases = generateCases(studyOf(kTwoAxes));
  EXPECT_THAT(cases[0].overrides,
              ElementsAre("duration_s=2", "a.b=5", "a.k=12.5", "c.shape={enabled: false}"));
  EXPECT_THAT(cases[7].overrides,
              ElementsAre("duration_s=2", "a.b=10", "a.k=50", "c.shape={fa: 20}"));
  EXPECT_EQ(commandLine(cases[7].command("x.yaml")),
            "ballbot run x.yaml --in-process --seed 8 --set duration_s=2 --set a.b=10 --set a.k=50 "
            "--set 'c.shape={fa: 20}'");
}

TEST(StudyCases, AFromThatIsNoAxisIsLeftAlone) {
  const std::vector<StudyCase> cases = generateCases(
      studyOf("set: {fmus: [{name: g, connections: [{from: g.y, to: 'plant.force.base_W[1]'}]}]}\n"
              "axes: [{name: k, paths: [fmus.0.gain], values: [1, 2]}]\n"));
  EXPECT_THAT(cases[0].overrides[0], HasSubstr("from: g.y, to: "));
  // A name of no axis where nothing else can be meant is still a mistake.
  const Study wrong =
      studyOf("set: {a: {from: b, times: 2}}\naxes: [{name: k, paths: [c], values: [1, 2]}]\n");
  EXPECT_THROW(generateCases(wrong), InputError);
}

TEST(StudyCases, TheNameOfACaseIsTheDigestOfWhatItRuns) {
  const std::vector<StudyCase> cases = generateCases(studyOf(kTwoAxes));
  std::set<std::string> ids;
  for (const StudyCase& c : cases) ids.insert(c.id);
  EXPECT_EQ(ids.size(), cases.size());
  // Another order of the values, one value more: the same runs keep their names.
  std::string text = kTwoAxes;
  text.replace(text.find("[5, 10]"), 7, "[10, 7, 5]");
  std::set<std::string> others;
  for (const StudyCase& c : generateCases(studyOf(text))) others.insert(c.id);
  EXPECT_TRUE(std::includes(others.begin(), others.end(), ids.begin(), ids.end()));
  EXPECT_EQ(others.size(), 12u);
}

TEST(StudyCases, ExclusionsTakeOutWhatMatchesThemInAllTheirLabels) {
  const Study study =
      studyOf(std::string(kTwoAxes) + "exclude: [{shaping: none, bandwidth: [10]}]\n");
  const std::vector<StudyCase> cases = generateCases(study);
  ASSERT_EQ(cases.size(), 6u);
  for (const StudyCase& c : cases)
    EXPECT_FALSE(c.point[0].label == "10" && c.point[1].label == "none");
}

TEST(StudyCases, TwoEqualRunsAreRefused) {
  try {
    generateCases(studyOf(
        "axes: [{name: a, options: [{label: x, set: {p: 1}}, {label: y, set: {p: 1}}]}]\n"));
    FAIL() << "ran the same case twice";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("two cases are the same run: 'a x, seed 1' and 'a y, seed 1'"));
  }
}

TEST(StudyCases, AnExpressionNeedsANumber) {
  try {
    generateCases(studyOf("axes: [{name: a, paths: p, values: [slow]}]\nset: {q: {from: a}}\n"));
    FAIL() << "computed with a word";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("axis 'a' is at 'slow', which is no number to compute from"));
  }
}

TEST(LatinHypercube, EachSliceOfEachAxisHoldsOneSample) {
  for (const int samples : {1, 7, 50}) {
    const auto points = latinHypercube(samples, 3, 11);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(samples));
    for (int d = 0; d < 3; ++d) {
      std::set<int> slices;
      for (const auto& p : points) {
        ASSERT_GE(p[d], 0);
        ASSERT_LT(p[d], 1);
        slices.insert(static_cast<int>(p[d] * samples));
      }
      EXPECT_EQ(slices.size(), static_cast<std::size_t>(samples));
    }
  }
}

TEST(LatinHypercube, IsAFunctionOfItsSeedAndItsAxesAreNotTheSame) {
  EXPECT_EQ(latinHypercube(20, 2, 5), latinHypercube(20, 2, 5));
  EXPECT_NE(latinHypercube(20, 2, 5), latinHypercube(20, 2, 6));
  double together = 0;
  const auto points = latinHypercube(200, 2, 5);
  for (const auto& p : points) together += (p[0] - 0.5) * (p[1] - 0.5) / 200;
  EXPECT_LT(std::abs(12 * together), 0.25) << "correlation of two independent axes of 200 samples";
}

TEST(LatinHypercube, SamplesLieInTheirRangeOnItsScale) {
  const Study study = studyOf(
      "design: latin_hypercube\nsamples: 40\n"
      "axes:\n"
      "  - {name: f, paths: [x], range: [5, 80], scale: log}\n"
      "  - {name: n, paths: [y], range: [0, 9], whole: true}\n");
  int below_20 = 0;
  const auto cases = generateCases(study);
  ASSERT_EQ(cases.size(), 40u);
  for (const StudyCase& c : cases) {
    EXPECT_GE(c.point[0].number, 5);
    EXPECT_LE(c.point[0].number, 80);
    EXPECT_EQ(c.point[1].number, std::round(c.point[1].number));
    below_20 += c.point[0].number < 20;
  }
  EXPECT_EQ(below_20, 20) << "20 Hz is the middle of 5 to 80 Hz on a log scale";
}

TEST(SettingText, ReadsBackToTheSameTree) {
  for (const std::string text :
       {"[1, -2.5, a/b]", "{enabled: false, x: [1, {y: \"no: \\\"quotes\\\"\"}]}", "\"17\"", "{}",
        "null", "{\"*k\": \"a\\x0ab\", \"null\": \"~\"}"}) {
    const ConfigNode tree = parseYaml(text, "test");
    EXPECT_EQ(toFlowYaml(parseYaml(toFlowYaml(tree), "again")), toFlowYaml(tree)) << text;
    EXPECT_EQ(toFlowYaml(tree), text);
  }
  EXPECT_EQ(shellQuoted("it's"), "'it'\\''s'");
  EXPECT_EQ(shellQuoted("a.b=2"), "a.b=2");
}

}  // namespace
}  // namespace ballbot
