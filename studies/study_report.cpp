#include "studies/study_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiment/verdict.hpp"
#include "report/svg_figure.hpp"
#include "studies/setting_text.hpp"
#include "studies/study_style.hpp"

namespace ballbot {
namespace {

constexpr std::size_t kExtremesShown = 5;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string withUnit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

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

/// A line through the middle and dashed ones through the ends, of one colour.
void addBand(SvgAxes& axes, const std::string& name, int colour, const std::vector<double>& x,
             const std::vector<double>& middle, const std::vector<double>& low,
             const std::vector<double>& high) {
  axes.series.push_back({name, colour, false, x, middle});
  axes.series.push_back({"", colour, true, x, low});
  axes.series.push_back({"", colour, true, x, high});
}

SvgAxes successAxes(const Study& study, const StudyView& view, const StudyPanel& panel) {
  SvgAxes axes;
  axes.x_label = withUnit(view.along->name, view.along->unit);
  axes.y_label = "share that passes";
  axes.log_x = logarithmic(view);
  int colour = 0;
  for (const StudyCurve& curve : panel.curves) {
    std::vector<double> x, middle, low, high;
    for (const auto& point : curve.points) {
      x.push_back(point.value);
      middle.push_back(point.rate.rate());
      low.push_back(point.rate.low);
      high.push_back(point.rate.high);
    }
    addBand(axes, curve.name.empty() ? "all" : curve.name, colour++ % 6, x, middle, low, high);
  }
  axes.at_y.push_back({fmt::format("{:g} %", 100 * study.report.rate), study.report.rate});
  return axes;
}

SvgAxes metricAxes(const StudyView& view, const StudyPanel& panel, const std::string& metric) {
  SvgAxes axes;
  axes.x_label = withUnit(view.along->name, view.along->unit);
  axes.y_label = withUnit(metric, unitOfMetric(metric));
  axes.log_x = logarithmic(view);
  int colour = 0;
  for (const StudyCurve& curve : panel.curves) {
    std::vector<double> x, middle, low, high;
    for (const auto& point : curve.points) {
      std::vector<double> values;  // of runs that did not fall: others end early
      for (const CaseResult* r : point.results) {
        const auto it = r->metrics.find(metric);
        if (it != r->metrics.end() && r->outcome <= CaseOutcome::kMissed)
          values.push_back(it->second);
      }
      if (values.empty()) continue;
      std::sort(values.begin(), values.end());
      x.push_back(point.value);
      middle.push_back(0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]));
      low.push_back(values.front());
      high.push_back(values.back());
    }
    if (!x.empty())
      addBand(axes, curve.name.empty() ? "all" : curve.name, colour % 6, x, middle, low, high);
    ++colour;
  }
  return axes;
}

/// Rows: curves. Columns: places along the axis. Each cell how many of how many passed, with a
/// colour that goes with it.
std::string heatMap(const StudyView& view, const StudyPanel& panel) {
  std::vector<std::pair<double, std::string>> columns;
  for (const StudyCurve& curve : panel.curves) {
    for (const auto& point : curve.points) {
      const std::pair<double, std::string> column{point.value, point.label};
      if (std::find(columns.begin(), columns.end(), column) == columns.end())
        columns.push_back(column);
    }
  }
  std::sort(columns.begin(), columns.end());
  std::string out = fmt::format("<table class=\"heat\"><thead><tr><th scope=\"col\">{}</th>",
                                escaped(withUnit(view.along->name, view.along->unit)));
  for (const auto& column : columns)
    out += fmt::format("<th scope=\"col\">{}</th>", escaped(column.second));
  out += "</tr></thead><tbody>";
  for (const StudyCurve& curve : panel.curves) {
    if (curve.points.empty()) continue;
    out += fmt::format("<tr><th scope=\"row\">{}</th>",
                       escaped(curve.name.empty() ? "all" : curve.name));
    for (const auto& column : columns) {
      const auto point = std::find_if(curve.points.begin(), curve.points.end(),
                                      [&](const auto& p) { return p.label == column.second; });
      out += point == curve.points.end()
                 ? std::string("<td class=\"none\"></td>")
                 : fmt::format("<td style=\"--rate:{:.3f}\">{}/{}</td>", point->rate.rate(),
                               point->rate.passed, point->rate.count);
    }
    out += "</tr>";
  }
  return out + "</tbody></table>";
}

std::string caseRow(const Study& study, const StudyCase& c, const CaseResult& r,
                    const std::string& metric) {
  const auto it = r.metrics.find(metric);
  const std::string value =
      it == r.metrics.end() ? "" : fmt::format("{:.4g} {}", it->second, unitOfMetric(metric));
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"number\">{}</td></tr>"
      "<tr class=\"command\"><td colspan=\"4\"><code>{}</code></td></tr>",
      escaped(c.describe(study)), toText(r.outcome), escaped(r.reason), escaped(value),
      escaped(commandLine(c.command(study.scenario))));
}

std::string caseTable(const std::string& title, const std::string& metric,
                      const std::string& rows) {
  if (rows.empty()) return "";
  return fmt::format(
      "<h3>{}</h3><table class=\"cases\"><thead><tr><th>case</th><th>outcome</th><th>reason</th>"
      "<th class=\"number\">{}</th></tr></thead><tbody>{}</tbody></table>",
      escaped(title), escaped(metric), rows);
}

std::string extremes(const Study& study, const StudyEngine& engine) {
  const std::string metric =
      study.report.metrics.empty() ? "largest_tilt_deg" : study.report.metrics.front();
  std::vector<const StudyCase*> whole, fallen, broken;
  for (const StudyCase& c : engine.cases()) {
    const CaseResult& r = engine.result(c);
    if (!ran(r.outcome)) {
      broken.push_back(&c);
    } else if (r.outcome == CaseOutcome::kFell) {
      fallen.push_back(&c);
    } else if (r.metrics.count(metric) > 0) {
      whole.push_back(&c);
    }
  }
  const auto value = [&](const StudyCase* c) { return engine.result(*c).metrics.at(metric); };
  std::stable_sort(whole.begin(), whole.end(), [&](auto a, auto b) { return value(a) < value(b); });
  std::stable_sort(fallen.begin(), fallen.end(), [&](auto a, auto b) {
    return engine.result(*a).simulated_s < engine.result(*b).simulated_s;
  });
  const auto rows = [&](const std::vector<const StudyCase*>& list) {
    std::string out;
    for (std::size_t i = 0; i < std::min(list.size(), kExtremesShown); ++i)
      out += caseRow(study, *list[i], engine.result(*list[i]), metric);
    return out;
  };
  std::string out = caseTable("Best by " + metric, metric, rows(whole));
  std::reverse(whole.begin(), whole.end());
  out += caseTable("Worst of those that stayed up", metric, rows(whole));
  out += caseTable("First to fall", metric, rows(fallen));
  return out + caseTable("Did not run", metric, rows(broken));
}

}  // namespace

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
    out.push_back({fmt::format("{}-{}.svg", study.name, number), title, svgFigure(title, axes)});
  }
  return out;
}

std::vector<std::string> studyAnswer(const Study& study, const StudyView& view) {
  std::vector<std::string> out;
  if (!view.along) return out;
  for (const StudyPanel& panel : view.panels) {
    for (const StudyCurve& curve : panel.curves) {
      if (curve.points.size() < 2) continue;
      std::string who = panel.name;
      if (view.curves)
        who += fmt::format("{}{} {}", who.empty() ? "" : ", ", view.curves->name, curve.name);
      if (who.empty()) who = study.name;
      if (!view.numeric) {
        std::string shares;
        for (const auto& point : curve.points) {
          shares += fmt::format("{}{} {}/{}", shares.empty() ? "" : ", ", point.label,
                                point.rate.passed, point.rate.count);
        }
        out.push_back(fmt::format("{}: passed {}.", who, shares));
        continue;
      }
      int cases = 0;
      for (const auto& point : curve.points) cases += point.rate.count;
      const Boundary b = curve.boundary(study.report.rate);
      out.push_back(fmt::format("{}: along {}, {}; from {} cases.", who, view.along->name,
                                toText(b, study.report.rate, view.along->unit), cases));
    }
  }
  return out;
}

std::string studyPage(const Study& study, const StudyEngine& engine,
                      const std::vector<PlaceBoundary>& boundaries) {
  const StudyView view = arrange(study, engine.cases(), engine.results());
  std::string body = fmt::format("<header><h1>{}</h1><p>{}</p></header>", escaped(study.name),
                                 escaped(study.summary));
  body += fmt::format(
      "<p class=\"facts\">{} cases: {} passed, {} missed a requirement, {} fell, {} did not run. "
      "Scenario <code>{}</code>. "
      "Table digest <code>{}</code>.</p>",
      engine.cases().size(), engine.count(CaseOutcome::kPassed), engine.count(CaseOutcome::kMissed),
      engine.count(CaseOutcome::kFell),
      engine.count(CaseOutcome::kError) + engine.count(CaseOutcome::kCrashed) +
          engine.count(CaseOutcome::kTimedOut),
      escaped(study.scenario), engine.table().digest());
  std::string answer;
  for (const PlaceBoundary& b : boundaries) {
    std::string place;
    for (std::size_t a = 0; a < b.place.size(); ++a) {
      if (!b.place[a].label.empty())
        place +=
            fmt::format("{}{} {}", place.empty() ? "" : ", ", study.axes[a].name, b.place[a].label);
    }
    answer += fmt::format(
        "<li>{}{}{}: {}.</li>", escaped(study.search->axis), place.empty() ? "" : " at ",
        escaped(place),
        escaped(toText(b.boundary, study.search->rate, study.axis(study.search->axis).unit)));
  }
  if (boundaries.empty()) {
    for (const std::string& sentence : studyAnswer(study, view))
      answer += fmt::format("<li>{}</li>", escaped(sentence));
  }
  if (!answer.empty()) body += "<section><h2>What came out</h2><ul>" + answer + "</ul></section>";
  if (view.along && boundaries.empty()) {
    const std::vector<StudyFigure> figures = studyFigures(study, view);
    for (std::size_t i = 0; i < view.panels.size(); ++i) {
      body += fmt::format(
          "<section><h2>{}</h2>{}<figure>{}<figcaption>Solid: share that passes, or median of runs "
          "that stayed up. "
          "Dashed: its 95 % interval (Wilson), or least and "
          "largest.</figcaption></figure></section>",
          escaped(figures[i].title), heatMap(view, view.panels[i]), figures[i].svg);
    }
  }
  body +=
      "<section><h2>Cases to look at</h2><p>Each command runs its case alone, with log, plots and "
      "replay.</p>" +
      extremes(study, engine) + "</section>";
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'\">"
      "<title>Study: {}</title><style>{}</style></head><body>{}</body></html>\n",
      escaped(study.name), kStudyStyle, body);
}

}  // namespace ballbot
