#include "report/svg_polar.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "report/svg_elements.hpp"
#include "report/svg_figure.hpp"

namespace ballbot {
namespace {

// In pixels of the figure.
constexpr double kRadius = 200, kMargin = 64, kLegendWidth = 330, kTitleHeight = 40;
constexpr double kPanelHeight = 2 * (kRadius + kMargin);
constexpr double kMiddleX = kMargin + kRadius + 30;
constexpr int kSpokes = 8;

/// Takes values at angles to pixels.
struct Place {
  double x0, y0, scale;
  double x(double angle_deg, double r) const {
    return x0 + scale * r * std::cos(kRadPerDeg * angle_deg);
  }
  double y(double angle_deg, double r) const {
    return y0 - scale * r * std::sin(kRadPerDeg * angle_deg);
  }
};

double largestRadius(const SvgPolar& axes) {
  double largest = 0;
  for (const SvgPolarCurve& c : axes.curves) {
    for (const auto* values : {&c.radius, &c.high}) {
      for (const double r : *values) {
        if (std::isfinite(r)) largest = std::max(largest, r);
      }
    }
  }
  return largest > 0 ? largest : 1;
}

std::string curveElement(const SvgPolarCurve& c, const Place& at) {
  const std::size_t count = std::min(c.angle_deg.size(), c.radius.size());
  std::string d;
  bool pen_down = false, whole = count > 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = c.radius[i];
    if (!std::isfinite(r)) {
      pen_down = whole = false;
      continue;
    }
    d += fmt::format("{}{} {}", pen_down ? "L" : "M", svgNumber(at.x(c.angle_deg[i], r)),
                     svgNumber(at.y(c.angle_deg[i], r)));
    pen_down = true;
  }
  const char* colour = kColours[c.colour % 6];
  std::string out =
      fmt::format("<path d='{}{}' fill='{}' fill-opacity='{}' stroke='{}' stroke-width='1.8'{}/>\n",
                  d, whole ? "Z" : "", whole && c.dotted ? colour : "none", 0.1, colour,
                  c.dashed ? " stroke-dasharray='7 4'" : "");
  for (std::size_t i = 0; i < count && c.dotted; ++i) {
    const double a = c.angle_deg[i], r = c.radius[i];
    if (!std::isfinite(r)) continue;
    out += fmt::format("<circle cx='{}' cy='{}' r='3' fill='{}'/>\n", svgNumber(at.x(a, r)),
                       svgNumber(at.y(a, r)), colour);
    if (i < c.low.size() && i < c.high.size() && std::isfinite(c.low[i]) &&
        std::isfinite(c.high[i])) {
      out +=
          lineElement(at.x(a, c.low[i]), at.y(a, c.low[i]), at.x(a, c.high[i]), at.y(a, c.high[i]),
                      fmt::format("stroke='{}' stroke-width='4' stroke-opacity='0.45'", colour));
    }
  }
  return out;
}

std::string gridElement(const SvgPolar& axes, const Place& at, double largest) {
  std::string out;
  for (const double r : axisTicks(0, largest, false)) {
    if (r <= 0) continue;
    out += fmt::format("<circle cx='{}' cy='{}' r='{}' fill='none' class='grid'/>\n",
                       svgNumber(at.x0), svgNumber(at.y0), svgNumber(at.scale * r));
    // Between two spokes, where no value is drawn over it.
    const double label_deg = 360.0 / kSpokes / 2;
    out += textElement(at.x(label_deg, r) + 2, at.y(label_deg, r) - 2, "start",
                       tickText(r) + " " + axes.unit, "fill-opacity='0.75'");
  }
  for (int i = 0; i < kSpokes; ++i) {
    const double a = 360.0 * i / kSpokes, c = std::cos(kRadPerDeg * a);
    out += lineElement(at.x0, at.y0, at.x(a, largest), at.y(a, largest), "class='grid'");
    const double beyond = largest + 12 / at.scale;
    const std::string name = i == 0             ? axes.x_name
                             : i == kSpokes / 4 ? axes.y_name
                                                : fmt::format("{:g}\xC2\xB0", a);
    out += textElement(at.x(a, beyond), at.y(a, beyond) + 4,
                       c > 0.1    ? "start"
                       : c < -0.1 ? "end"
                                  : "middle",
                       name, "class='label'");
  }
  return out;
}

std::string panel(const SvgPolar& axes, double top) {
  const double largest = 1.02 * largestRadius(axes);
  const Place at{kMiddleX, top + kMargin + kRadius, kRadius / largest};
  std::string out;
  if (!axes.title.empty()) {
    out += textElement(kMiddleX, top + 22, "middle", axes.title, "class='label'");
  }
  out += gridElement(axes, at, largest);
  for (const SvgPolarCurve& c : axes.curves) out += curveElement(c, at);
  const double left = kMiddleX + kRadius + kMargin + 20;
  double row = top + kMargin + 12;
  for (const SvgPolarCurve& c : axes.curves) {
    out += lineElement(left, row - 4, left + 26, row - 4,
                       fmt::format("stroke='{}' stroke-width='2.2'{}", kColours[c.colour % 6],
                                   c.dashed ? " stroke-dasharray='7 4'" : ""));
    out += textElement(left + 33, row, "start", c.name);
    row += 18;
  }
  return out;
}

}  // namespace

std::string svgPolarFigure(const std::string& title, const std::vector<SvgPolar>& axes) {
  const double top = title.empty() ? 12 : kTitleHeight;
  std::string out = figureBeginning(title, kMiddleX + kRadius + kMargin + kLegendWidth,
                                    top + static_cast<double>(axes.size()) * kPanelHeight, kMargin);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    out += panel(axes[i], top + static_cast<double>(i) * kPanelHeight);
  }
  return out + "</svg>\n";
}

}  // namespace ballbot
