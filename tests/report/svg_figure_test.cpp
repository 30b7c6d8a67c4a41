#include "report/svg_figure.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace ballbot {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pointwise;

SvgAxes line(std::vector<double> x, std::vector<double> y) {
  SvgAxes axes;
  axes.x_label = "frequency [Hz]";
  axes.y_label = "gain";
  axes.series.push_back({"curve", 0, false, std::move(x), std::move(y)});
  return axes;
}

TEST(AxisTicks, AreRoundNumbersInsideTheAxis) {
  const std::vector<double> fifths = {0, 0.2, 0.4, 0.6, 0.8, 1};
  EXPECT_THAT(axisTicks(0, 1, false), Pointwise(DoubleNear(1e-12), fifths));
  const std::vector<double> ticks = axisTicks(-37, 81, false);
  EXPECT_EQ(ticks.front(), -20);
  EXPECT_EQ(ticks.back(), 80);
}

TEST(AxisTicks, OfALongLogAxisAreDecadesAndOfAShortOneOneTwoFive) {
  EXPECT_THAT(axisTicks(0.05, 500, true), ElementsAre(0.1, 1, 10, 100));
  EXPECT_THAT(axisTicks(1, 10, true), ElementsAre(1, 2, 5, 10));
}

TEST(SvgFigure, PutsTheEndsOfALineIntoTheCornersOfItsAxes) {
  SvgAxes axes = line({1, 1000}, {1, 100});
  axes.log_x = axes.log_y = true;
  // Plot area: x from 84 to 704, y from 12 to 202.
  EXPECT_THAT(svgFigure("", {axes}), HasSubstr("M84.00 202.00L704.00 12.00"));
}

TEST(SvgFigure, ABandRunsForthAboveAndBackBelow) {
  SvgAxes axes = line({1, 1000}, {10, 10});
  axes.log_x = axes.log_y = true;
  axes.bands.push_back({2, {1, 1000}, {1, 1}, {100, 100}});
  // The band spans the whole plot area; the line lies in its middle.
  const std::string svg = svgFigure("", {axes});
  EXPECT_THAT(svg, HasSubstr("M84.00 12.00L704.00 12.00L704.00 202.00L84.00 202.00Z"));
  EXPECT_THAT(svg, HasSubstr("M84.00 107.00L704.00 107.00"));
}

TEST(SvgFigure, BreaksALineAtValuesThatCannotBeDrawn) {
  SvgAxes axes = line({1, 2, 3, 4}, {1, std::nan(""), 3, 4});
  EXPECT_THAT(svgFigure("", {axes}), Not(HasSubstr("nan")));
  SvgAxes log = line({1, 2, 3, 4}, {1, -5, 3, 4});
  log.log_y = true;
  EXPECT_THAT(svgFigure("", {log}), Not(HasSubstr("nan")));
}

TEST(SvgFigure, NamesAxesLinesAndMarksAndEscapesThem) {
  SvgAxes axes = line({0, 1}, {0, 1});
  axes.series[0].name = "a < b & c";
  axes.at_y.push_back({"limit", 0.5});
  const std::string svg = svgFigure("Title", {axes});
  EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(svg, HasSubstr(">limit<"));
  EXPECT_THAT(svg, HasSubstr(">frequency [Hz]<"));
  EXPECT_THAT(svg, HasSubstr("<title>Title</title>"));
}

TEST(SvgFigure, WritesWordsWhereAnAxisHasThemInsteadOfNumbers) {
  SvgAxes axes = line({0, 1}, {0.25, 0.75});
  axes.x_words = {"ideal", "+ springs"};
  const std::string svg = svgFigure("", {axes});
  EXPECT_THAT(svg, HasSubstr(">ideal<"));
  EXPECT_THAT(svg, HasSubstr(">+ springs<"));
  EXPECT_THAT(svg, Not(HasSubstr(">1</text>"))) << "a number along x";
}

TEST(SvgFigure, FetchesNothing) {
  const std::string svg = svgFigure("Title", {line({0, 1}, {0, 1})});
  EXPECT_THAT(svg, Not(HasSubstr("href")));
  EXPECT_THAT(svg, Not(HasSubstr("@import")));
}

TEST(SvgFigure, OfNothingIsEmptyAxes) {
  EXPECT_THAT(svgFigure("", {line({}, {})}), HasSubstr("</svg>"));
}

}  // namespace
}  // namespace ballbot
