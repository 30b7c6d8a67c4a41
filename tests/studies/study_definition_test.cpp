#include "studies/study_definition.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "tests/studies/support_study.hpp"

namespace ballbot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string refusal(const std::string& text) {
  try {
    studyOf(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(StudyDefinition, ReadsTheShippedStudies) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(BALLBOT_SOURCE_DIR "/configs/studies")) {
    const Study study = loadStudy(entry.path().string());
    EXPECT_EQ(study.name, entry.path().stem().string());
    EXPECT_FALSE(study.summary.empty());
    EXPECT_TRUE(std::filesystem::exists(study.scenario)) << study.scenario;
    ++count;
  }
  EXPECT_GE(count, 6);
}

TEST(StudyDefinition, SeedsAreACountOrAList) {
  EXPECT_THAT(studyOf("seeds: 3\n").seeds, ElementsAre(1, 2, 3));
  EXPECT_THAT(studyOf("seeds: [7, 2]\n").seeds, ElementsAre(7, 2));
  EXPECT_THAT(studyOf("").seeds, ElementsAre(1));
  EXPECT_THAT(refusal("seeds: [1, 1]\n"), HasSubstr("'seeds' must be different from each other"));
  EXPECT_THAT(refusal("seeds: 1.5\n"),
              HasSubstr("'seeds' must be how many (1, 2, ...) or a list of seeds"));
}

TEST(StudyDefinition, AListOfCasesIsAnAxis) {
  const Study study = studyOf("cases: [{label: a, set: {x: 1}}, {label: b, set: {x: 2, y: 3}}]\n");
  ASSERT_EQ(study.axes.size(), 1u);
  EXPECT_EQ(study.axes[0].name, "variant");
  EXPECT_EQ(study.axes[0].options[1].settings[1].first, "y");
}

TEST(StudyDefinition, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(refusal("axis: []\n"), HasSubstr(":3:"));
  EXPECT_THAT(refusal("axis: []\n"), HasSubstr("did you mean 'axes'?"));
  EXPECT_THAT(
      refusal("axes: [{name: a, values: [1]}]\n"),
      HasSubstr("name: axis 'a' has no 'paths': which configuration values does it change?"));
  EXPECT_THAT(refusal("axes: [{name: a, paths: x}]\n"),
              HasSubstr("must have either 'values' (or 'range') for its 'paths', or 'options'"));
  EXPECT_THAT(refusal("axes: [{name: a, paths: x, values: [1, 1]}]\n"),
              HasSubstr("name: axis 'a' has '1' twice"));
  EXPECT_THAT(
      refusal("axes: [{name: a, paths: x, values: [1]}, {name: a, paths: y, values: [1]}]\n"),
      HasSubstr("two axes are called 'a'"));
  EXPECT_THAT(refusal("axes: [{name: a, paths: x, range: [2, 1]}]\n"),
              HasSubstr("is [2, 1], the second must be larger"));
  EXPECT_THAT(refusal("axes: [{name: a, paths: x, range: [0, 1], scale: log}]\n"),
              HasSubstr("must be positive with scale: log"));
  EXPECT_THAT(refusal("axes: [{name: a, paths: x, range: [1, 2]}]\n"),
              HasSubstr("a grid needs 'values'"));
  EXPECT_THAT(refusal("axes: [{name: a, paths: x, values: [1]}]\nexclude: [{a: 2}]\n"),
              HasSubstr("axis 'a' has no '2'"));
  EXPECT_THAT(refusal("axes: [{name: seed, paths: x, values: [1]}]\n"),
              HasSubstr("an axis is called 'seed', as a column that every table has"));
  EXPECT_THAT(refusal("axes: [{name: a, paths: x, values: [1]}]\nsearch: {axis: a}\n"),
              HasSubstr(": axis 'a' has no 'range' to search in"));
  EXPECT_THAT(refusal("axes: [{name: a, paths: x, values: [1], whole: true}]\n"),
              HasSubstr("whole belongs to a 'range'"));
  EXPECT_THAT(refusal("samples: 3\n"), HasSubstr("samples belongs to design: latin_hypercube"));
  EXPECT_THAT(refusal("design: latin_hypercube\n"), HasSubstr("samples is missing"));
  EXPECT_THAT(refusal("report: {along: b}\n"), HasSubstr("there is no axis 'b'"));
  EXPECT_THAT(refusal("axes: [{name: a, paths: [{path: x, times: 2}], values: [word]}]\n"),
              HasSubstr("'word' is not a number, so 'x' cannot be computed from it"));
}

}  // namespace
}  // namespace ballbot
