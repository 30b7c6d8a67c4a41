#include "studies/study_search.hpp"

#include <limits>

#include <fmt/format.h>

#include "studies/study_view.hpp"

namespace ballbot {
namespace {

/// Over all seeds at a place.
RateEstimate rateAt(const std::vector<StudyCase>& cases, const StudyEngine& engine) {
  std::vector<const CaseResult*> results;
  for (const StudyCase& c : cases) results.push_back(&engine.result(c));
  return rateOf(results);
}

}  // namespace

std::vector<StudyCase> searchProbeCases(const Study& study) {
  const std::size_t searched = study.axisIndex(study.search->axis);
  const StudyAxis& axis = study.axes[searched];
  std::vector<StudyCase> out;
  for (std::vector<AxisOption> place : gridPlaces(study)) {
    for (const double value : {axis.range->low, axis.range->middle(), axis.range->high}) {
      place[searched] = optionAt(axis, value);
      for (StudyCase& c : casesAt(study, place)) out.push_back(std::move(c));
    }
  }
  return out;
}

std::vector<PlaceBoundary> runSearch(const Study& study, StudyEngine& engine) {
  const SearchDefinition& wanted = *study.search;
  const std::size_t searched = study.axisIndex(wanted.axis);
  const StudyAxis& axis = study.axes[searched];
  std::vector<std::vector<AxisOption>> places = gridPlaces(study);
  std::vector<BoundarySearch> searches(places.size(),
                                       BoundarySearch(*axis.range, wanted.rate, wanted.resolution));

  struct Question {
    std::size_t place;
    double value;
    std::vector<StudyCase> cases;
  };
  while (true) {
    std::vector<Question> questions;
    std::vector<StudyCase> round;
    for (std::size_t p = 0; p < places.size(); ++p) {
      for (const double value : searches[p].next()) {
        places[p][searched] = optionAt(axis, value);
        questions.push_back({p, value, casesAt(study, places[p])});
        round.insert(round.end(), questions.back().cases.begin(), questions.back().cases.end());
      }
    }
    if (questions.empty()) break;
    engine.run(round);
    for (const Question& q : questions) searches[q.place].tell(q.value, rateAt(q.cases, engine));
  }

  std::vector<PlaceBoundary> out;
  for (std::size_t p = 0; p < places.size(); ++p) {
    PlaceBoundary b;
    for (std::size_t a = 0; a < places[p].size(); ++a) {
      const AxisOption& option = places[p][a];
      b.place.push_back(
          a == searched ? AxisPoint{"", std::numeric_limits<double>::quiet_NaN()}
                        : AxisPoint{option.label, option.number.value_or(
                                                      std::numeric_limits<double>::quiet_NaN())});
    }
    b.boundary = searches[p].boundary();
    out.push_back(std::move(b));
  }
  return out;
}

std::string toText(const Boundary& b, double rate, const std::string& unit) {
  const std::string u = unit.empty() ? "" : " " + unit;
  if (b.kind == Boundary::Kind::kPassesEverywhere)
    return fmt::format("at least {:g} % pass everywhere in the range", 100 * rate);
  if (b.kind == Boundary::Kind::kPassesNowhere)
    return fmt::format("fewer than {:g} % pass everywhere in the range", 100 * rate);
  if (b.kind == Boundary::Kind::kUnknown)
    return "where cases stop to pass is unknown: none ran at a value that decides it";
  const auto end = [&](const std::optional<double>& value, const char* open) {
    return value ? fmt::format("{:.3g}", *value) : std::string(open);
  };
  return fmt::format("{:g} % pass {} {:.3g}{} (95 %: {} to {}{})", 100 * rate,
                     b.rising ? "above" : "below", b.estimate, u, end(b.low, "below the range"),
                     end(b.high, "above the range"), u);
}

}  // namespace ballbot
