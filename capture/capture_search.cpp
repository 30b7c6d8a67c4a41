#include "capture/capture_search.hpp"

#include <cmath>
#include <limits>

#include "studies/study_view.hpp"

namespace ballbot {
namespace {

// Steps are whole numbers: the bisection ends at neighbours.
constexpr double kNeighbours = 1e-9;

Boundary scaled(Boundary b, double factor) {
  b.estimate *= factor;
  for (auto* end : {&b.low, &b.high}) {
    if (*end) **end *= factor;
  }
  return b;
}

}  // namespace

CaptureSearch::CaptureSearch(const CaptureRequest& request, const Study& study,
                             std::vector<double> up_to_N)
    : request_(request), study_(study) {
  for (std::size_t v = 0; v < request.variants.size(); ++v) {
    for (std::size_t d = 0; d < request.durations_s.size(); ++d) {
      for (std::size_t h = 0; h < request.heights_m.size(); ++h) {
        const double steps =
            std::ceil(up_to_N[d * request.heights_m.size() + h] / request.resolution_N - 1e-9);
        for (int i = 0; i < request.directions; ++i) {
          lines_.push_back(
              {v, d, h, i, BoundarySearch({0, steps, false, true}, request.rate, kNeighbours)});
        }
      }
    }
  }
}

std::vector<StudyCase> CaptureSearch::casesOf(const Line& line, double steps) const {
  std::vector<AxisOption> place(study_.axes.size());
  place[kVariantAxis] = study_.axes[kVariantAxis].options[line.variant];
  place[kDurationAxis] = study_.axes[kDurationAxis].options[line.duration];
  place[kHeightAxis] = study_.axes[kHeightAxis].options[line.height];
  place[kDirectionAxis] =
      study_.axes[kDirectionAxis].options[static_cast<std::size_t>(line.direction)];
  place[kForceAxis] = optionAt(study_.axes[kForceAxis], steps * request_.resolution_N);
  return casesAt(study_, place);
}

std::vector<StudyCase> CaptureSearch::next() {
  asked_.clear();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (at_rest_) {
      if (lines_[i].direction == 0) asked_.push_back({i, 0, casesOf(lines_[i], 0)});
      continue;
    }
    for (const double steps : lines_[i].search.next()) {
      asked_.push_back({i, steps, casesOf(lines_[i], steps)});
    }
  }
  std::vector<StudyCase> out;
  for (const Question& q : asked_) out.insert(out.end(), q.cases.begin(), q.cases.end());
  return out;
}

void CaptureSearch::take(const StudyEngine& engine) {
  for (const Question& q : asked_) {
    std::vector<const CaseResult*> results;
    for (const StudyCase& c : q.cases) results.push_back(&engine.result(c));
    const RateEstimate rate = rateOf(results);
    // Without a force there are no directions: the lines of one place stand one after the other.
    const std::size_t count = at_rest_ ? static_cast<std::size_t>(request_.directions) : 1;
    for (std::size_t i = 0; i < count; ++i) lines_[q.line + i].search.tell(q.steps, rate);
  }
  at_rest_ = false;
  asked_.clear();
}

std::size_t CaptureSearch::casesLeft() const {
  std::size_t values = 0;
  for (const Line& line : lines_) values += static_cast<std::size_t>(line.search.expectedLeft());
  // Counted for each direction, asked for once.
  if (at_rest_) {
    values -= lines_.size() - lines_.size() / static_cast<std::size_t>(request_.directions);
  }
  return values * static_cast<std::size_t>(request_.seeds);
}

std::vector<CaptureEdge> CaptureSearch::edges() const {
  std::vector<CaptureEdge> out;
  for (const Line& line : lines_) {
    CaptureEdge edge{line.variant, line.duration, line.height, line.direction, {}, {}, {}};
    edge.boundary = scaled(line.search.boundary(), request_.resolution_N);
    for (const auto& [steps, rate] : line.search.known()) {
      if (rate.rate() < request_.rate) {
        edge.fallen_N = steps * request_.resolution_N;
        break;
      }
      edge.survived_N = steps * request_.resolution_N;
    }
    out.push_back(edge);
  }
  return out;
}

std::vector<PlaceBoundary> CaptureSearch::boundaries() const {
  std::vector<PlaceBoundary> out;
  const std::vector<CaptureEdge> found = edges();
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    PlaceBoundary b;
    const auto point = [](const AxisOption& option) {
      return AxisPoint{option.label,
                       option.number.value_or(std::numeric_limits<double>::quiet_NaN())};
    };
    b.place = {point(study_.axes[kVariantAxis].options[line.variant]),
               point(study_.axes[kDurationAxis].options[line.duration]),
               point(study_.axes[kHeightAxis].options[line.height]),
               point(study_.axes[kDirectionAxis].options[static_cast<std::size_t>(line.direction)]),
               AxisPoint{"", std::numeric_limits<double>::quiet_NaN()}};
    b.boundary = found[i].boundary;
    out.push_back(b);
  }
  return out;
}

}  // namespace ballbot
