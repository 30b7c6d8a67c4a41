#include "report/svg_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "report/svg_elements.hpp"

namespace ballbot {
namespace {

// In pixels of the figure. The legend's column is as wide as its longest names need.
constexpr double kLeft = 84, kPlotWidth = 620, kLegendWidth = 236, kPlotHeight = 190;
constexpr double kTitleHeight = 40, kBelow = 58;
constexpr int kTickCount = 6;

/// Maps values of one direction to pixels.
class Scale {
 public:
  Scale(double low, double high, bool log, double first, double last)
      : log_(log), low_(of(low)), high_(of(high)), first_(first), last_(last) {}
  bool has(double v) const { return std::isfinite(v) && (!log_ || v > 0); }
  double operator()(double v) const {
    const double share = (of(v) - low_) / (high_ - low_);
    // Far outside is as good as outside: viewers dislike huge coordinates.
    return first_ + std::clamp(share, -10.0, 11.0) * (last_ - first_);
  }

 private:
  double of(double v) const { return log_ ? std::log10(v) : v; }
  bool log_;
  double low_, high_, first_, last_;
};

struct Span {
  double low, high;
};

/// From the least to the greatest of what can be drawn; with some room where the axis is linear.
Span spanOf(const SvgAxes& axes, bool of_x) {
  const bool log = of_x ? axes.log_x : axes.log_y;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto take = [&](double v) {
    if (!std::isfinite(v) || (log && v <= 0)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  };
  for (const SvgSeries& s : axes.series)
    for (const double v : of_x ? s.x : s.y) take(v);
  for (const SvgBand& b : axes.bands) {
    for (const double v : of_x ? b.x : b.low) take(v);
    for (const double v : of_x ? b.x : b.high) take(v);
  }
  if (!of_x) {
    for (const SvgMark& m : axes.at_y) take(m.value);
  }
  if (!(low <= high)) return log ? Span{1, 10} : Span{0, 1};
  if (low == high) {
    low = log ? low / 2 : low - 1;
    high = log ? high * 2 : high + 1;
  }
  if (of_x) return {low, high};
  if (log)
    return {std::pow(10, std::floor(std::log10(low) + 1e-9)),
            std::pow(10, std::ceil(std::log10(high) - 1e-9))};
  const double room = 0.06 * (high - low);
  return {low - room, high + room};
}

std::string path(const SvgSeries& s, const Scale& sx, const Scale& sy) {
  std::string d;
  bool pen_down = false;
  for (std::size_t i = 0; i < std::min(s.x.size(), s.y.size()); ++i) {
    if (!sx.has(s.x[i]) || !sy.has(s.y[i])) {
      pen_down = false;
      continue;
    }
    d += fmt::format("{}{} {}", pen_down ? "L" : "M", svgNumber(sx(s.x[i])), svgNumber(sy(s.y[i])));
    pen_down = true;
  }
  return fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='1.8'{}/>\n", d,
                     kColours[s.colour % 6], s.dashed ? " stroke-dasharray='7 4'" : "");
}

std::string area(const SvgBand& b, const Scale& sx, const Scale& sy) {
  std::string forth, back;
  for (std::size_t i = 0; i < b.x.size(); ++i) {
    if (!sx.has(b.x[i]) || !sy.has(b.low[i]) || !sy.has(b.high[i])) continue;
    const std::string x = svgNumber(sx(b.x[i]));
    forth += fmt::format("{}{} {}", forth.empty() ? "M" : "L", x, svgNumber(sy(b.high[i])));
    back = fmt::format("L{} {}", x, svgNumber(sy(b.low[i]))) + back;
  }
  if (forth.empty()) return "";
  return fmt::format("<path d='{}{}Z' fill='{}' fill-opacity='0.14'/>\n", forth, back,
                     kColours[b.colour % 6]);
}

/// Grid lines between the labelled ones of a log axis.
std::vector<double> minorTicks(double low, double high) {
  std::vector<double> out;
  for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10) {
    for (int i = 2; i < 10; ++i) {
      if (i * decade > low && i * decade < high) out.push_back(i * decade);
    }
  }
  return out;
}

std::string axesElement(const SvgAxes& axes, double top, int index) {
  const Span x = spanOf(axes, true), y = spanOf(axes, false);
  const double right = kLeft + kPlotWidth, bottom = top + kPlotHeight;
  const Scale sx(x.low, x.high, axes.log_x, kLeft, right);
  const Scale sy(y.low, y.high, axes.log_y, bottom, top);
  std::string out;
  for (const SvgSpan& s : axes.shaded) {
    const double from = std::clamp(sx(s.from), kLeft, right),
                 to = std::clamp(sx(s.to), kLeft, right);
    out +=
        fmt::format("<rect x='{}' y='{}' width='{}' height='{}' class='span'/>\n", svgNumber(from),
                    svgNumber(top), svgNumber(std::max(0.0, to - from)), svgNumber(kPlotHeight));
  }
  if (axes.log_x) {
    for (const double v : minorTicks(x.low, x.high))
      out += lineElement(sx(v), top, sx(v), bottom, "class='minor'");
  }
  if (axes.log_y) {
    for (const double v : minorTicks(y.low, y.high))
      out += lineElement(kLeft, sy(v), right, sy(v), "class='minor'");
  }
  const std::size_t words = axes.x_words.size();
  for (std::size_t i = 0; i < words; ++i) {
    const double at = sx(static_cast<double>(i));
    out += lineElement(at, top, at, bottom, "class='grid'");
    out += textElement(at, bottom + 17 + (i % 2 == 0 ? 0 : 14), "middle",
                       axes.x_words[i]);  // in two rows
  }
  for (const double v : words > 0 ? std::vector<double>() : axisTicks(x.low, x.high, axes.log_x)) {
    out += lineElement(sx(v), top, sx(v), bottom, "class='grid'");
    out += textElement(sx(v), bottom + 17, "middle", tickText(v));
  }
  for (const double v : axisTicks(y.low, y.high, axes.log_y)) {
    out += lineElement(kLeft, sy(v), right, sy(v), "class='grid'");
    out += textElement(kLeft - 7, sy(v) + 4, "end", tickText(v));
  }
  out += fmt::format(
      "<clipPath id='c{}'><rect x='{}' y='{}' width='{}' height='{}'/></clipPath>\n<g "
      "clip-path='url(#c{})'>\n",
      index, svgNumber(kLeft), svgNumber(top), svgNumber(kPlotWidth), svgNumber(kPlotHeight),
      index);
  for (const SvgMark& m : axes.at_x)
    out += lineElement(sx(m.value), top, sx(m.value), bottom, "class='mark'");
  for (const SvgMark& m : axes.at_y)
    out += lineElement(kLeft, sy(m.value), right, sy(m.value), "class='mark'");
  for (const SvgBand& b : axes.bands) out += area(b, sx, sy);
  for (const SvgSeries& s : axes.series) out += path(s, sx, sy);
  out += "</g>\n";
  out +=
      fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#333'/>\n",
                  svgNumber(kLeft), svgNumber(top), svgNumber(kPlotWidth), svgNumber(kPlotHeight));
  out += textElement(kLeft + kPlotWidth / 2, bottom + (words > 0 ? 48 : 37), "middle", axes.x_label,
                     "class='label'");
  const double middle = top + kPlotHeight / 2;
  out += textElement(18, middle, "middle", axes.y_label,
                     fmt::format("class='label' transform='rotate(-90 18 {})'", svgNumber(middle)));
  // Legend: one row a line, marks last.
  double row = top + 12;
  for (const SvgSeries& s : axes.series) {
    if (s.name.empty()) continue;
    out += lineElement(right + 14, row - 4, right + 40, row - 4,
                       fmt::format("stroke='{}' stroke-width='2.2'{}", kColours[s.colour % 6],
                                   s.dashed ? " stroke-dasharray='7 4'" : ""));
    out += textElement(right + 47, row, "start", s.name);
    row += 18;
  }
  for (const auto* marks : {&axes.at_x, &axes.at_y}) {
    for (const SvgMark& m : *marks) {
      if (m.name.empty()) continue;
      out += lineElement(right + 14, row - 4, right + 40, row - 4, "class='mark'");
      out += textElement(right + 47, row, "start", m.name);
      row += 18;
    }
  }
  return out;
}

}  // namespace

std::vector<double> axisTicks(double low, double high, bool log) {
  std::vector<double> out;
  if (log) {
    const bool wide = high / low >= 100;
    for (int e = static_cast<int>(std::floor(std::log10(low)));
         e <= static_cast<int>(std::ceil(std::log10(high))); ++e) {
      for (const int factor : {1, 2, 5}) {
        const double v = factor * std::pow(10.0, e);
        if ((factor == 1 || !wide) && v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9))
          out.push_back(v);
      }
    }
    return out;
  }
  const double rough = (high - low) / kTickCount;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = decade * (rough > 5 * decade   ? 10
                                : rough > 2 * decade ? 5
                                : rough > decade     ? 2
                                                     : 1);
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
    out.push_back(k == 0 ? 0 : k * step);
  }
  return out;
}

std::string svgFigure(const std::string& title, const std::vector<SvgAxes>& axes) {
  const double width = kLeft + kPlotWidth + kLegendWidth;
  const double top = title.empty() ? 12 : kTitleHeight;
  const double height = top + static_cast<double>(axes.size()) * (kPlotHeight + kBelow);
  std::string out = figureBeginning(title, width, height, kLeft);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    out += axesElement(axes[i], top + static_cast<double>(i) * (kPlotHeight + kBelow),
                       static_cast<int>(i));
  }
  return out + "</svg>\n";
}

}  // namespace ballbot
