#include "capture/capture_study.hpp"

#include <gmock/gmock.h>

#include "capture/capture_search.hpp"
#include "core/error.hpp"
#include "experiment/scenario_variants.hpp"

namespace ballbot {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

CaptureRequest twoVariants() {
  CaptureRequest r;
  r.scenario = BALLBOT_SOURCE_DIR "/configs/scenarios/push.yaml";
  r.variants = {{"as given", {}}, CaptureVariant::of("controller.kind=lqr; rates.base_step_us=50")};
  r.directions = 4;
  return r;
}

TEST(CaptureStudy, SetsTheForceAlongEachDirection) {
  const CaptureRequest r = twoVariants();
  const Study study = captureStudy(r, 100);
  std::vector<AxisOption> place(study.axes.size());
  for (std::size_t a = 0; a < kForceAxis; ++a) place[a] = study.axes[a].options.front();
  place[kForceAxis] = optionAt(study.axes[kForceAxis], 60);
  for (int i = 0; i < r.directions; ++i) {
    place[kDirectionAxis] = study.axes[kDirectionAxis].options[static_cast<std::size_t>(i)];
    const std::vector<StudyCase> cases = casesAt(study, place);
    ASSERT_EQ(cases.size(), 3u) << "one a seed";
    const char* force[] = {"[60, 0, 0]", "[0, 60, 0]", "[-60, 0, 0]", "[0, -60, 0]"};
    EXPECT_THAT(cases[0].overrides,
                Contains(std::string("environment.pushes.0.force_N=") + force[i]));
    const Scenario scenario = readScenario(loadScenarioTree(r.scenario), cases[0].overrides, 1);
    const ConfigNode* pushes = scenario.tree.find("environment")->find("pushes");
    ASSERT_EQ(pushes->items().size(), 1u) << "the scenario's own are left out";
    const ConfigNode& push = pushes->items()[0];
    EXPECT_EQ(push.find("point_m")->items()[2].text(), "0.35");
    EXPECT_EQ(push.find("force_N")->items()[2].text(), "0");
    EXPECT_EQ(push.find("duration_s")->text(), "0.5");
    EXPECT_EQ(toSeconds(kSimStart + scenario.duration), 3 + 0.5 + 5);
    ASSERT_EQ(scenario.requirements.size(), 1u);
    EXPECT_EQ(scenario.requirements[0].metric, "fell");
  }
}

TEST(CaptureStudy, AVariantIsOneOrMoreChanges) {
  const CaptureRequest r = twoVariants();
  EXPECT_EQ(r.variants[1].label, "controller.kind=lqr; rates.base_step_us=50");
  EXPECT_EQ(r.variants[1].overrides.size(), 2u);
  EXPECT_THROW(CaptureVariant::of(" ; "), InputError);
  EXPECT_THROW(CaptureVariant::of("controller.kind"), InputError);
}

TEST(CaptureStudy, RefusesWhatItDecidesItself) {
  for (const char* text : {"duration_s=3", "environment.pushes=[]",
                           "environment.pushes.0.body=ball", "requirements={}", "seed=4"}) {
    CaptureRequest all = twoVariants(), one = twoVariants();
    all.overrides = {text};
    one.variants[1].overrides = {text};
    for (const CaptureRequest& r : {all, one}) {
      try {
        captureStudy(r, 100);
        ADD_FAILURE() << text << " was taken";
      } catch (const InputError& e) {
        EXPECT_THAT(e.what(), HasSubstr(text));
        EXPECT_THAT(e.what(), HasSubstr("is what a capture decides itself"));
      }
    }
  }
}

}  // namespace
}  // namespace ballbot
