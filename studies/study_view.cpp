#include "studies/study_view.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace ballbot {
namespace {

constexpr std::size_t kNoAxis = static_cast<std::size_t>(-1);

/// Different labels that the cases have on an axis, in the order in which they come, numbers
/// sorted.
std::vector<AxisPoint> pointsOn(std::size_t axis, const std::vector<StudyCase>& cases) {
  std::vector<AxisPoint> out;
  for (const StudyCase& c : cases) {
    const AxisPoint& point = c.point[axis];
    if (std::none_of(out.begin(), out.end(),
                     [&](const AxisPoint& p) { return p.label == point.label; }))
      out.push_back(point);
  }
  if (std::all_of(out.begin(), out.end(),
                  [](const AxisPoint& p) { return std::isfinite(p.number); })) {
    std::sort(out.begin(), out.end(),
              [](const AxisPoint& a, const AxisPoint& b) { return a.number < b.number; });
  }
  return out;
}

bool numeric(const std::vector<AxisPoint>& points) {
  return points.size() > 1 && std::isfinite(points.front().number) &&
         std::isfinite(points.back().number);
}

std::string panelName(const Study& study, const StudyCase& c, std::size_t along,
                      std::size_t curves) {
  std::string name;
  for (std::size_t a = 0; a < study.axes.size(); ++a) {
    if (a == along || a == curves) continue;
    const StudyAxis& axis = study.axes[a];
    name += fmt::format("{}{} {}{}{}", name.empty() ? "" : ", ", axis.name, c.point[a].label,
                        axis.unit.empty() ? "" : " ", axis.unit);
  }
  return name;
}

}  // namespace

Boundary StudyCurve::boundary(double rate) const {
  std::map<double, RateEstimate> rates;
  for (const Point& point : points) {
    if (point.rate.count > 0) rates[point.value] = point.rate;
  }
  return rates.size() < 2 ? Boundary{Boundary::Kind::kUnknown, true, 0, {}, {}}
                          : boundaryIn(rates, rate);
}

RateEstimate rateOf(const std::vector<const CaseResult*>& results) {
  int passed = 0, count = 0;
  for (const CaseResult* r : results) {
    passed += r->outcome == CaseOutcome::kPassed;
    count += ran(r->outcome);
  }
  return wilsonInterval(passed, count);
}

std::optional<MetricSpread> StudyCurve::Point::spread(const std::string& metric) const {
  std::vector<double> values;
  for (const CaseResult* r : results) {
    const auto it = r->metrics.find(metric);
    if (it != r->metrics.end() && r->outcome <= CaseOutcome::kMissed) values.push_back(it->second);
  }
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const double middle = 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
  return MetricSpread{values.front(), middle, values.back()};
}

std::string curveLabel(const StudyView& view, const StudyCurve& curve) {
  if (!view.curves) return "all";
  const auto& options = view.curves->options;
  const bool numbers = std::all_of(options.begin(), options.end(), [](const AxisOption& option) {
    return option.number.has_value();
  });
  if (!numbers || options.empty()) return curve.name;
  const std::string& unit = view.curves->unit;
  return fmt::format("{} {}{}{}", view.curves->name, curve.name, unit.empty() ? "" : " ", unit);
}

StudyView arrange(const Study& study, const std::vector<StudyCase>& cases,
                  const std::map<std::string, CaseResult>& results) {
  StudyView view;
  std::vector<std::vector<AxisPoint>> points;
  for (std::size_t a = 0; a < study.axes.size(); ++a) points.push_back(pointsOn(a, cases));
  std::size_t along = study.report.along.empty() ? kNoAxis : study.axisIndex(study.report.along);
  std::size_t curves = study.report.curves.empty() ? kNoAxis : study.axisIndex(study.report.curves);
  for (std::size_t a = 0; along == kNoAxis && a < points.size(); ++a) {
    for (std::size_t b = 0; b < points.size(); ++b) {
      if (b != curves && numeric(points[b]) &&
          (along == kNoAxis || points[b].size() > points[along].size()))
        along = b;
    }
  }
  if (along == kNoAxis && !points.empty()) along = curves == 0 && points.size() > 1 ? 1 : 0;
  for (std::size_t a = 0; study.report.curves.empty() && a < points.size(); ++a) {
    if (a != along && points[a].size() > 1 &&
        (curves == kNoAxis || points[a].size() < points[curves].size()))
      curves = a;
  }
  if (along == kNoAxis) return view;
  view.along = &study.axes[along];
  if (curves != kNoAxis) view.curves = &study.axes[curves];

  const std::vector<AxisPoint> ticks = points[along];
  const bool numbers = view.numeric = numeric(ticks);
  const std::vector<AxisPoint> names =
      curves == kNoAxis ? std::vector<AxisPoint>{{"", 0}} : points[curves];
  for (const StudyCase& c : cases) {
    const auto found = results.find(c.id);
    if (found == results.end()) continue;
    const std::string name = panelName(study, c, along, curves);
    auto panel = std::find_if(view.panels.begin(), view.panels.end(),
                              [&](const StudyPanel& p) { return p.name == name; });
    if (panel == view.panels.end()) {
      view.panels.push_back({name, {}});
      panel = std::prev(view.panels.end());
      for (const AxisPoint& curve : names) {
        panel->curves.push_back({curve.label, {}});
        for (std::size_t i = 0; i < ticks.size(); ++i) {
          panel->curves.back().points.push_back(
              {ticks[i].label, numbers ? ticks[i].number : static_cast<double>(i), {}, {}});
        }
      }
    }
    const std::string curve_name = curves == kNoAxis ? "" : c.point[curves].label;
    for (StudyCurve& curve : panel->curves) {
      if (curve.name != curve_name) continue;
      for (StudyCurve::Point& point : curve.points) {
        if (point.label == c.point[along].label) point.results.push_back(&found->second);
      }
    }
  }
  for (StudyPanel& panel : view.panels) {
    for (StudyCurve& curve : panel.curves) {
      auto& p = curve.points;
      p.erase(std::remove_if(p.begin(), p.end(),
                             [](const StudyCurve::Point& x) { return x.results.empty(); }),
              p.end());
      for (StudyCurve::Point& point : p) {
        point.rate = rateOf(point.results);
      }
    }
  }
  return view;
}

}  // namespace ballbot
