#include "report/write_report.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "tests/report/example_run.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

/// The data as a browser takes them from the page: up to the first end of a script element.
nlohmann::json dataOf(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"report-data\">";
  const auto begin = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script", begin) - begin));
}

std::string example() { return reportPage(exampleRun(), exampleUrdf()); }

TEST(WriteReport, PutsAllOfTheRunIntoThePage) {
  const ReportData run = exampleRun();
  const nlohmann::json data = dataOf(example());
  EXPECT_EQ(data["title"], run.title);
  EXPECT_EQ(data["passed"], true);
  ASSERT_EQ(data["requirements"].size(), run.requirements.size());
  EXPECT_EQ(data["requirements"][0]["value"], run.requirements[0].value);
  EXPECT_EQ(data["metrics"].size(), run.metrics.size());
  EXPECT_EQ(data["phases"].size(), run.phases.size());
  EXPECT_EQ(data["phases"][0]["kind"], "push");
  EXPECT_EQ(data["manifest"].size(), run.manifest.size());
  ASSERT_EQ(data["groups"].size(), run.groups.size());
  EXPECT_EQ(data["groups"][0]["axes"][0]["unit"], "m");
  EXPECT_EQ(data["replay"]["urdf"], exampleUrdf());
  EXPECT_EQ(data["replay"]["joints"].size(), 6u);
}

TEST(WriteReport, NeedsNothingBesideThePage) {
  const std::string page = example();
  EXPECT_THAT(page, StartsWith("<!doctype html>"));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy\" content=\"default-src 'none'"));
  for (const char* link : {"<link rel=\"stylesheet", "<script src", "<img", "@import"})
    EXPECT_THAT(page, Not(HasSubstr(link)));
}

TEST(WriteReport, NoTextEndsTheScriptThatCarriesIt) {
  const std::size_t plain = count(example(), "</script");
  ReportData run = exampleRun();
  const std::string hostile = "</script><script>alert(1)</script><!-- & \" ' \\ \u2028";
  run.title = run.subtitle = run.verdict = hostile;
  run.documents = {{hostile, hostile}};
  run.groups[0].axes[0].quantity = hostile;
  const std::string page = reportPage(run, exampleUrdf() + "<!-- " + hostile + "-->");
  EXPECT_EQ(count(page, "</script"), plain);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_EQ(dataOf(page)["title"], hostile);
  EXPECT_EQ(dataOf(page)["documents"][0]["text"], hostile);
}

TEST(WriteReport, SaysTheVerdictInTheTitle) {
  ReportData run = exampleRun();
  run.title = "a < b & c";
  EXPECT_THAT(reportPage(run, exampleUrdf()), HasSubstr("<title>Passed: a &lt; b &amp; c</title>"));
  run.passed = false;
  EXPECT_THAT(reportPage(run, exampleUrdf()), HasSubstr("<title>Failed: a &lt; b &amp; c</title>"));
}

TEST(WriteReport, TakesTextThatIsNotUtf8AndNumbersThatAreNone) {
  ReportData run = exampleRun();
  run.manifest = {{"host", "caf\xe9"}};
  run.metrics = {{"", "undefined", std::numeric_limits<double>::quiet_NaN(), ""}};
  const nlohmann::json data = dataOf(reportPage(run, exampleUrdf()));
  EXPECT_EQ(data["manifest"][0]["text"], "caf\xef\xbf\xbd");
  EXPECT_TRUE(data["metrics"][0]["value"].is_null());
}

TEST(WriteReport, ListsSharedTimesOnceAndEvenOnesAsAStep) {
  const nlohmann::json data = dataOf(example());
  const std::size_t listed = data["groups"][0]["axes"][0]["series"][0]["time"];
  const auto& times = data["times"].at(listed);
  EXPECT_EQ(times["start"], 0.0);
  EXPECT_NEAR(times["step"].get<double>(), 2.5e-3, 1e-12);
  EXPECT_EQ(times["count"], 4000 + 1);
  EXPECT_EQ(data["groups"][1]["axes"][1]["series"][0]["time"], listed);
}

TEST(WriteReport, StaysSmall) {
  ReportData run = exampleRun();
  const auto tilt = run.groups[1].axes[0].series[0];
  run.groups = {{"All", "", {}, {}}};
  for (int i = 0; i < 20; ++i) {
    PlotAxes axes{"signal", "", {}, {}};
    for (int k = 0; k < 3; ++k) axes.series.push_back(tilt);
    run.groups[0].axes.push_back(axes);
  }
  EXPECT_LT(reportPage(run, exampleUrdf()).size(), 2.6e6) << "60 series over 10 s at 400 Hz";

  const std::size_t ten_seconds = reportPage(run, exampleUrdf()).size();
  for (PlotAxes& axes : run.groups[0].axes) {
    for (PlotSeries& series : axes.series) {
      for (int i = 1; i <= 12000; ++i) {
        series.t.push_back(10 + 2.5e-3 * i);
        series.values.push_back(std::sin(0.3 * i));
      }
    }
  }
  run.end_s = 40;
  EXPECT_LT(reportPage(run, exampleUrdf()).size(), 1.5 * static_cast<double>(ten_seconds))
      << "four times as long";
}

TEST(WriteReport, GivesTheSameBytesTwice) { EXPECT_EQ(example(), example()); }

TEST(WriteReport, WritesThePageToTheFile) {
  const auto path = std::filesystem::path(testing::TempDir()) / "write_report_test.html";
  writeReport(exampleRun(), exampleUrdf(), path);
  std::ifstream file(path, std::ios::binary);
  const std::string written{std::istreambuf_iterator<char>(file), {}};
  EXPECT_TRUE(written == example());
  std::filesystem::remove(path);
}

TEST(WriteReport, SaysWhyAFileCannotBeWritten) {
  const auto complaint = [](const std::string& path) -> std::string {
    try {
      writeReport(exampleRun(), exampleUrdf(), path);
    } catch (const OutputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("/no/such/folder/report.html"),
            "/no/such/folder/report.html: the report cannot be written: No such file or directory");
  EXPECT_EQ(complaint("/dev/full"),
            "/dev/full: the report cannot be written: No space left on device");
}

}  // namespace
}  // namespace ballbot
