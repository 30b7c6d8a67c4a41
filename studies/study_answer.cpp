#include "studies/study_answer.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/verdict.hpp"
#include "studies/study_figures.hpp"
#include "studies/study_search.hpp"

namespace ballbot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Between which values the level is crossed: up to `low` the rate is surely below it, from `high`
/// on surely above. Where it falls with the value, values have their sign turned, so that less is
/// better in both.
struct Need {
  double low = -kInfinity, high = kInfinity;
};

Need needOf(const StudyCurve& curve, double rate, bool rising) {
  std::vector<StudyCurve::Point> points = curve.points;
  if (!rising) {
    std::reverse(points.begin(), points.end());
    for (StudyCurve::Point& p : points) p.value = -p.value;
  }
  Need need;
  for (auto p = points.begin(); p != points.end() && p->rate.high < rate; ++p) need.low = p->value;
  for (auto p = points.rbegin(); p != points.rend() && p->rate.low > rate; ++p)
    need.high = p->value;
  return need;
}

/// Of the curves that do cross the level: does more along the axis help?
bool mostlyRises(const StudyView& view, double rate) {
  int votes = 0;
  for (const StudyPanel& panel : view.panels) {
    for (const StudyCurve& curve : panel.curves) {
      if (curve.points.size() < 2) continue;
      const Boundary b = curve.boundary(rate);
      if (b.kind == Boundary::Kind::kFound) votes += b.rising ? 1 : -1;
    }
  }
  return votes >= 0;
}

struct Tally {
  int better = 0, worse = 0, unclear = 0;
  int flat = 0;                    ///< of the unclear: neither curve crosses the level
  std::vector<std::string> gains;  ///< "10.2 to 7.5 Hz (by spring, delay 10 ms)"
};

Tally compare(const StudyView& view, std::size_t curve, double rate, bool rising) {
  Tally tally;
  for (const StudyPanel& panel : view.panels) {
    if (curve >= panel.curves.size()) continue;
    const StudyCurve& first = panel.curves.front();
    const StudyCurve& other = panel.curves[curve];
    if (first.points.size() < 2 || other.points.size() < 2) continue;
    const Need first_need = needOf(first, rate, rising), other_need = needOf(other, rate, rising);
    const bool better = other_need.high <= first_need.low;
    const bool worse = first_need.high <= other_need.low;
    (better ? tally.better : worse ? tally.worse : tally.unclear) += 1;
    const Boundary a = first.boundary(rate), b = other.boundary(rate);
    if (!better && !worse && a.kind != Boundary::Kind::kFound && b.kind != Boundary::Kind::kFound)
      ++tally.flat;
    if ((!better && !worse) || a.kind != Boundary::Kind::kFound || b.kind != Boundary::Kind::kFound)
      continue;
    tally.gains.push_back(fmt::format("from {:.3g} to {:.3g}{}{}", a.estimate, b.estimate,
                                      view.along->unit.empty() ? "" : " " + view.along->unit,
                                      panel.name.empty() ? "" : " at " + panel.name));
  }
  return tally;
}

/// What stands still in a curve: its panel and its own name.
std::string placeOf(const StudyView& view, const StudyPanel& panel, const StudyCurve& curve) {
  std::string who = panel.name;
  if (view.curves) {
    who += fmt::format("{}{} {}{}{}", who.empty() ? "" : ", ", view.curves->name, curve.name,
                       view.curves->unit.empty() ? "" : " ", view.curves->unit);
  }
  return who;
}

/// Metrics at the steps of a ladder, and which step changes them for certain: by more than what the
/// seeds scatter.
std::string alongSteps(const StudyCurve& curve, const std::string& metric) {
  std::string values, changes;
  std::optional<MetricSpread> before;
  for (const StudyCurve::Point& point : curve.points) {
    const auto now = point.spread(metric);
    values += fmt::format("{}{} {}", values.empty() ? "" : ", ", point.label,
                          now ? fmt::format("{:.3g}", now->middle) : std::string("none"));
    if (before && now && (now->low > before->high || now->high < before->low)) {
      changes += fmt::format("{}'{}' ({:.3g} to {:.3g})", changes.empty() ? "" : ", ", point.label,
                             before->middle, now->middle);
    }
    if (now) before = now;
  }
  return fmt::format("median {}; {}", values,
                     changes.empty()
                         ? std::string("no step changes it by more than the seeds scatter")
                         : "changed by more than the seeds scatter at " + changes);
}

std::string rangeOverPlaces(const StudyView& view, const std::string& metric) {
  struct Extreme {
    double value = 0;
    std::string place;
  };
  std::optional<Extreme> least, largest;
  for (const StudyPanel& panel : view.panels) {
    for (const StudyCurve& curve : panel.curves) {
      for (const StudyCurve::Point& point : curve.points) {
        const auto spread = point.spread(metric);
        if (!spread) continue;
        std::string place = placeOf(view, panel, curve);
        place += fmt::format("{}{} {}{}{}", place.empty() ? "" : ", ", view.along->name,
                             point.label, view.along->unit.empty() ? "" : " ", view.along->unit);
        if (!least || spread->middle < least->value) least = Extreme{spread->middle, place};
        if (!largest || spread->middle > largest->value) largest = Extreme{spread->middle, place};
      }
    }
  }
  if (!least) return "";
  return fmt::format("median from {:.3g} ({}) to {:.3g} ({})", least->value, least->place,
                     largest->value, largest->place);
}

}  // namespace

std::vector<std::string> studyAnswer(const Study& study, const StudyView& view) {
  std::vector<std::string> out;
  if (!view.along) return out;
  for (const StudyPanel& panel : view.panels) {
    for (const StudyCurve& curve : panel.curves) {
      if (curve.points.size() < 2) continue;
      std::string who = placeOf(view, panel, curve);
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
      int cases = 0, lost = 0;
      for (const auto& point : curve.points) {
        cases += point.rate.count;
        lost += static_cast<int>(point.results.size()) - point.rate.count;
      }
      const Boundary b = curve.boundary(study.report.rate);
      out.push_back(fmt::format("{}: along {}, {}; from {} cases{}.", who, view.along->name,
                                toText(b, study.report.rate, view.along->unit), cases,
                                lost > 0 ? fmt::format(", {} more did not run", lost) : ""));
    }
  }
  return out;
}

std::vector<std::string> studyComparison(const Study& study, const StudyView& view) {
  std::vector<std::string> out;
  if (!view.numeric || !view.curves || view.panels.empty()) return out;
  const double rate = study.report.rate;
  const bool rising = mostlyRises(view, rate);
  const std::vector<StudyCurve>& curves = view.panels.front().curves;
  for (std::size_t i = 1; i < curves.size(); ++i) {
    const Tally tally = compare(view, i, rate, rising);
    const int all = tally.better + tally.worse + tally.unclear;
    if (all == 0 || tally.flat == all) continue;
    std::string text = fmt::format(
        "{0} {1} against {2}: passes with {3} {4} in {5} of {6} comparisons, needs {7} in {8}; in "
        "{9} "
        "no difference is certain",
        view.curves->name, curves[i].name, curves.front().name, rising ? "less" : "more",
        view.along->name, tally.better, all, rising ? "more" : "less", tally.worse, tally.unclear);
    if (!tally.gains.empty()) text += fmt::format(" ({})", fmt::join(tally.gains, "; "));
    out.push_back(text + ".");
  }
  return out;
}

std::vector<std::string> studyMetrics(const Study& study, const StudyView& view) {
  std::vector<std::string> out;
  if (!view.along) return out;
  for (const std::string& metric : study.report.metrics) {
    const std::string name = withUnit(metric, unitOfKey(metric));
    if (view.numeric) {
      const std::string range = rangeOverPlaces(view, metric);
      if (!range.empty()) out.push_back(fmt::format("{}: {}.", name, range));
      continue;
    }
    for (const StudyPanel& panel : view.panels) {
      for (const StudyCurve& curve : panel.curves) {
        const std::string who = placeOf(view, panel, curve);
        out.push_back(fmt::format("{}{}{}: {}.", name, who.empty() ? "" : ", ", who,
                                  alongSteps(curve, metric)));
      }
    }
  }
  return out;
}

}  // namespace ballbot
