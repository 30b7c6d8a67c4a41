#include "report/svg_polar.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

SvgPolar polar(std::vector<double> angle_deg, std::vector<double> radius) {
  SvgPolar axes{"", "N", "x", "y", {}};
  axes.curves.push_back({"survived", 1, false, true, std::move(angle_deg), std::move(radius)});
  return axes;
}

// The middle is at (294, 276); the largest radius 100 lies at 200/1.02 pixels from it.
TEST(SvgPolarFigure, DrawsAnglesFromTheRightUpwards) {
  const std::string svg = svgPolarFigure("", {polar({0, 90, 180, 270}, {100, 50, 100, 50})});
  EXPECT_THAT(svg, HasSubstr("M490.08 276.00L294.00 177.96L97.92 276.00L294.00 374.04Z"));
}

TEST(SvgPolarFigure, BreaksACurveAtValuesThatCannotBeDrawn) {
  const std::string svg = svgPolarFigure("", {polar({0, 90, 180}, {100, std::nan(""), 100})});
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, HasSubstr("M490.08 276.00M97.92 276.00'"));
}

TEST(SvgPolarFigure, DrawsHowSureAValueIsAsABarAlongItsDirection) {
  SvgPolar axes = polar({0, 180}, {50, 100});
  axes.curves[0].low = {25, std::nan("")};
  axes.curves[0].high = {75, 100};
  const std::string svg = svgPolarFigure("", {axes});
  EXPECT_THAT(svg, HasSubstr("x1='343.02' y1='276.00' x2='441.06' y2='276.00'"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(SvgPolarFigure, NamesDirectionsRingsAndCurvesAndEscapesThem) {
  SvgPolar axes = polar({0, 90}, {100, 80});
  axes.curves[0].name = "a < b";
  axes.x_name = "x, forward";
  const std::string svg = svgPolarFigure("Title", {axes});
  for (const char* words : {">a &lt; b<", ">x, forward<", ">y<", ">180°<", ">40 N<", ">Title<"}) {
    EXPECT_THAT(svg, HasSubstr(words));
  }
}

TEST(SvgPolarFigure, DrawsAxesWithNothingInThem) {
  EXPECT_THAT(svgPolarFigure("", {polar({}, {})}), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace ballbot
