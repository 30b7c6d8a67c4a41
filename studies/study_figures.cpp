#include "studies/study_figures.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "experiment/verdict.hpp"
#include "report/svg_figure.hpp"

namespace ballbot {
namespace {

bool logarithmic(const StudyView& view) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const StudyPanel& panel : view.panels) {
    for (const StudyCurve& curve : panel.curves) {
      for (const auto& point : curve.points) {
        low = std::min(low, point.value);
        high = std::max(high, point.value);
      }
    }
  }
  return low > 0 && high > 5 * low;
}

/// A line through the middle of a band.
void addBand(SvgAxes& axes, const std::string& name, int colour, const std::vector<double>& x,
             const std::vector<double>& middle, const std::vector<double>& low,
             const std::vector<double>& high) {
  axes.series.push_back({name, colour, false, x, middle});
  axes.bands.push_back({colour, x, low, high});
}

/// Without anything drawn yet.
SvgAxes axesAlong(const StudyView& view, const StudyPanel& panel) {
  SvgAxes axes;
  axes.x_label = withUnit(view.along->name, view.along->unit);
  if (view.numeric) {
    axes.log_x = logarithmic(view);
    return axes;
  }
  for (const StudyCurve& curve : panel.curves) {
    for (const auto& point : curve.points) {
      const auto position = static_cast<std::size_t>(point.value);
      axes.x_words.resize(std::max(axes.x_words.size(), position + 1));
      axes.x_words[position] = point.label;
    }
  }
  return axes;
}

SvgAxes successAxes(const Study& study, const StudyView& view, const StudyPanel& panel) {
  SvgAxes axes = axesAlong(view, panel);
  axes.y_label = "share that passes";
  int colour = 0;
  for (const StudyCurve& curve : panel.curves) {
    std::vector<double> x, middle, low, high;
    for (const auto& point : curve.points) {
      if (point.rate.count == 0) continue;
      x.push_back(point.value);
      middle.push_back(point.rate.rate());
      low.push_back(point.rate.low);
      high.push_back(point.rate.high);
    }
    addBand(axes, curveLabel(view, curve), colour++ % 6, x, middle, low, high);
  }
  axes.at_y.push_back({fmt::format("{:g} %", 100 * study.report.rate), study.report.rate});
  return axes;
}

SvgAxes metricAxes(const StudyView& view, const StudyPanel& panel, const std::string& metric) {
  SvgAxes axes = axesAlong(view, panel);
  axes.y_label = withUnit(metric, unitOfKey(metric));
  int colour = 0;
  for (const StudyCurve& curve : panel.curves) {
    std::vector<double> x, middle, low, high;
    for (const auto& point : curve.points) {
      const auto spread = point.spread(metric);
      if (!spread) continue;
      x.push_back(point.value);
      middle.push_back(spread->middle);
      low.push_back(spread->low);
      high.push_back(spread->high);
    }
    if (!x.empty()) addBand(axes, curveLabel(view, curve), colour % 6, x, middle, low, high);
    ++colour;
  }
  return axes;
}

}  // namespace

std::string withUnit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

std::vector<StudyFigure> studyFigures(const Study& study, const StudyView& view) {
  std::vector<StudyFigure> out;
  int number = 0;
  for (const StudyPanel& panel : view.panels) {
    ++number;
    const std::string title = panel.name.empty() ? study.name : panel.name;
    std::vector<SvgAxes> axes = {successAxes(study, view, panel)};
    for (const std::string& metric : study.report.metrics) {
      SvgAxes more = metricAxes(view, panel, metric);
      if (!more.series.empty()) axes.push_back(std::move(more));
    }
    out.push_back({fmt::format("{}-{}", study.name, number), title, svgFigure(title, axes)});
  }
  return out;
}

}  // namespace ballbot
