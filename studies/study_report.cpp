#include "studies/study_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/markup_text.hpp"
#include "experiment/verdict.hpp"
#include "studies/setting_text.hpp"
#include "studies/study_answer.hpp"
#include "studies/study_figures.hpp"
#include "studies/study_style.hpp"

namespace ballbot {
namespace {

constexpr std::size_t kExtremesShown = 5;

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
                                markupEscaped(withUnit(view.along->name, view.along->unit)));
  for (const auto& column : columns)
    out += fmt::format("<th scope=\"col\">{}</th>", markupEscaped(column.second));
  out += "</tr></thead><tbody>";
  for (const StudyCurve& curve : panel.curves) {
    if (curve.points.empty()) continue;
    out += fmt::format("<tr><th scope=\"row\">{}</th>", markupEscaped(curveLabel(view, curve)));
    for (const auto& column : columns) {
      const auto point = std::find_if(curve.points.begin(), curve.points.end(),
                                      [&](const auto& p) { return p.label == column.second; });
      out += point == curve.points.end() || point->rate.count == 0
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
      it == r.metrics.end() ? "" : fmt::format("{:.4g} {}", it->second, unitOfKey(metric));
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"number\">{}</td></tr>"
      "<tr class=\"command\"><td colspan=\"4\"><code>{}</code></td></tr>",
      markupEscaped(c.describe(study)), toText(r.outcome), markupEscaped(r.reason),
      markupEscaped(value), markupEscaped(commandLine(c.command(study.scenario))));
}

std::string caseTable(const std::string& title, const std::string& metric,
                      const std::string& rows) {
  if (rows.empty()) return "";
  return fmt::format(
      "<h3>{}</h3><table class=\"cases\"><thead><tr><th>case</th><th>outcome</th><th>reason</th>"
      "<th class=\"number\">{}</th></tr></thead><tbody>{}</tbody></table>",
      markupEscaped(title), markupEscaped(metric), rows);
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

std::string studyPage(const Study& study, const StudyEngine& engine,
                      const std::vector<PlaceBoundary>& boundaries) {
  const StudyView view = arrange(study, engine.cases(), engine.results());
  std::string body = fmt::format("<header><h1>{}</h1><p>{}</p></header>", markupEscaped(study.name),
                                 markupEscaped(study.summary));
  body += fmt::format(
      "<p class=\"facts\">{} cases: {} passed, {} missed a requirement, {} fell, {} did not run. "
      "Scenario <code>{}</code>. "
      "Table digest <code>{}</code>.</p>",
      engine.cases().size(), engine.count(CaseOutcome::kPassed), engine.count(CaseOutcome::kMissed),
      engine.count(CaseOutcome::kFell),
      engine.count(CaseOutcome::kError) + engine.count(CaseOutcome::kCrashed) +
          engine.count(CaseOutcome::kTimedOut),
      markupEscaped(study.scenario), engine.table().digest());
  std::string answer;
  for (const PlaceBoundary& b : boundaries) {
    std::string place;
    for (std::size_t a = 0; a < b.place.size(); ++a) {
      if (!b.place[a].label.empty())
        place +=
            fmt::format("{}{} {}", place.empty() ? "" : ", ", study.axes[a].name, b.place[a].label);
    }
    answer += fmt::format(
        "<li>{}{}{}: {}.</li>", markupEscaped(study.search->axis), place.empty() ? "" : " at ",
        markupEscaped(place),
        markupEscaped(toText(b.boundary, study.search->rate, study.axis(study.search->axis).unit)));
  }
  if (boundaries.empty()) {
    for (const std::string& sentence : studyComparison(study, view))
      answer += fmt::format("<li><strong>{}</strong></li>", markupEscaped(sentence));
    for (const std::string& sentence : studyAnswer(study, view))
      answer += fmt::format("<li>{}</li>", markupEscaped(sentence));
    for (const std::string& sentence : studyMetrics(study, view))
      answer += fmt::format("<li>{}</li>", markupEscaped(sentence));
  }
  if (!answer.empty()) body += "<section><h2>What came out</h2><ul>" + answer + "</ul></section>";
  if (view.along && boundaries.empty()) {
    const std::vector<StudyFigure> figures = studyFigures(study, view);
    for (std::size_t i = 0; i < view.panels.size(); ++i) {
      body += fmt::format(
          "<section><h2>{}</h2>{}<figure>{}<figcaption>Lines: share that passes, or median of runs "
          "that stayed up. Bands: its 95 % interval (Wilson), or least and "
          "largest.</figcaption></figure></section>",
          markupEscaped(figures[i].title), heatMap(view, view.panels[i]), figures[i].svg);
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
      markupEscaped(study.name), kStudyStyle, body);
}

}  // namespace ballbot
