#include "report/report_check.hpp"

#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

using ::testing::StrEq;

constexpr char kUrdf[] = "<robot/>";

ReportData soundReport() {
  ReportData data;
  data.end_s = 2;
  PlotAxes axes{"tilt", "deg", {{"roll", SeriesStyle::kMeasured, 0, {0, 1, 2}, {3, 4, 5}}}, {}};
  PathAxes path{
      "way", "x", "y", "m", {{"ball", SeriesStyle::kMeasured, 0, {0, 1}, {0, 1}, {1, 0}}}};
  data.groups = {{"Base", "", {axes}, {path}}};
  data.phases = {{ReportPhase::Kind::kPush, 0.5, 1, "push"}};
  ReportReplay replay;
  replay.t = {0, 1};
  replay.bodies = {{"base", {ReplayPose{}, ReplayPose{}}}};
  replay.joints = {{"wheel_1_joint", {0, 1}}};
  replay.objects = {{"wall", {1, 1, 1}, {ReplayPose{}}}};
  data.replay = replay;
  return data;
}

std::string complaint(const ReportData& data, const std::string& urdf = kUrdf) {
  try {
    checkReportData(data, urdf);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CheckReportData, AcceptsASoundReport) { EXPECT_THAT(complaint(soundReport()), StrEq("")); }

TEST(CheckReportData, NamesTheSeriesWhoseLengthsDiffer) {
  ReportData data = soundReport();
  data.groups[0].axes[0].series[0].values.pop_back();
  EXPECT_THAT(complaint(data), StrEq("report: series 'roll' of 'tilt' has 2 values for 3 times"));
  data = soundReport();
  data.groups[0].paths[0].series[0].y.push_back(0);
  EXPECT_THAT(complaint(data), StrEq("report: series 'ball' of 'way' has 3 y values for 2 times"));
}

TEST(CheckReportData, RefusesTimesThatDoNotAscend) {
  ReportData data = soundReport();
  data.groups[0].axes[0].series[0].t = {0, 1, 1};
  EXPECT_THAT(complaint(data), StrEq("report: series 'roll' of 'tilt' has times that do not "
                                     "ascend: 1 s after 1 s at index 2"));
  data = soundReport();
  data.replay->t[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint(data), StrEq("report: the replay has the time nan at index 0"));
}

TEST(CheckReportData, RefusesAColourThePageDoesNotHave) {
  ReportData data = soundReport();
  data.groups[0].axes[0].series[0].channel = 6;
  EXPECT_THAT(complaint(data),
              StrEq("report: series 'roll' of 'tilt' has colour channel 6, must be 0 to 5"));
}

TEST(CheckReportData, RefusesLanesTablesAndViewsThatContradictThemselves) {
  ReportData data = soundReport();
  data.groups[0].lanes = {{"drive", {{0, 1, "on"}, {1, 2, "off"}}}};
  data.tables = {{"checks", "", {"time", "check"}, {{{"0", "late"}, true}}}};
  data.documents = {{"page.md", "# Page"}};
  data.headline = {{"what to do", "page", "page.md"}};
  data.view = ReportView{0.5, 1, 0.7};
  EXPECT_THAT(complaint(data), StrEq(""));
  ReportData wrong = data;
  wrong.groups[0].lanes[0].stretches[1].start_s = 0.5;
  EXPECT_THAT(complaint(wrong),
              StrEq("report: lane 'drive' has 'off' from 0.5 s to 2 s at index 1, "
                    "before the one before it has ended"));
  wrong = data;
  wrong.tables[0].rows[0].cells.pop_back();
  EXPECT_THAT(complaint(wrong), StrEq("report: table 'checks' has 1 cells in row 0 for 2 columns"));
  wrong = data;
  wrong.headline[0].document = "other.md";
  EXPECT_THAT(complaint(wrong), StrEq("report: fact 'what to do' opens 'other.md', which is no "
                                      "document of it"));
  wrong = data;
  wrong.view->end_s = 3;
  EXPECT_THAT(complaint(wrong),
              StrEq("report: the view spans 0.5 s to 3 s, must lie in the run's 0 "
                    "s to 2 s"));
}

TEST(CheckReportData, RefusesAReplayThatCannotBeDrawn) {
  EXPECT_THAT(complaint(soundReport(), ""),
              StrEq("report: the replay needs the text of the robot's URDF"));
  ReportData data = soundReport();
  data.replay->followed_link = "torso";
  EXPECT_THAT(complaint(data),
              StrEq("report: the replay follows link 'torso', which is not among its bodies"));
  data = soundReport();
  data.replay->joints[0].angle.clear();
  EXPECT_THAT(complaint(data),
              StrEq("report: replay of joint 'wheel_1_joint' has 0 angles for 2 times"));
  data = soundReport();
  data.replay->objects[0].poses.resize(3);
  EXPECT_THAT(complaint(data), StrEq("report: replay of object 'wall' has 3 poses for 2 times"));
}

TEST(CheckReportData, RefusesARunWithoutDurationAndAPhaseThatRunsBackwards) {
  ReportData data = soundReport();
  data.end_s = 0;
  EXPECT_THAT(complaint(data), StrEq("report: the run spans 0 s to 0 s, must have a duration"));
  data = soundReport();
  data.phases[0].end_s = 0.25;
  EXPECT_THAT(complaint(data), StrEq("report: phase 'push' lasts from 0.5 s to 0.25 s"));
}

}  // namespace
}  // namespace ballbot
