#include "studies/boundary_search.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace ballbot {

RateEstimate wilsonInterval(int passed, int count) {
  constexpr double z = 1.959963984540054;  // 97.5 % of a standard normal lie below
  RateEstimate e{passed, count, 0, 1};
  if (count == 0) return e;
  const double n = count, p = passed / n;
  const double centre = (p + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  e.low = passed == 0 ? 0 : centre - half;
  e.high = passed == count ? 1 : centre + half;
  return e;
}

bool BoundarySearch::holds(Level level, const RateEstimate& r) const {
  switch (level) {
    case Level::kSurelyFails:
      return r.high >= rate_;  // false only where it surely fails
    case Level::kPasses:
      return r.rate() >= rate_;
    case Level::kSurelyPasses:
      return r.low > rate_;
  }
  return false;
}

std::optional<BoundarySearch::Bracket> BoundarySearch::bracket(Level level) const {
  std::vector<std::pair<double, RateEstimate>> line(known_.begin(), known_.end());
  if (line.front().second.rate() > line.back().second.rate())
    std::reverse(line.begin(), line.end());
  // Now from the failing to the passing end.
  const auto ok = [&](std::size_t i) { return holds(level, line[i].second); };
  if (level == Level::kSurelyFails) {
    if (ok(0)) return std::nullopt;
    std::size_t i = 0;
    while (i + 1 < line.size() && !ok(i + 1)) ++i;
    if (i + 1 == line.size()) return std::nullopt;
    return Bracket{line[i].first, line[i + 1].first};
  }
  std::size_t i = line.size() - 1;
  if (!ok(i)) return std::nullopt;
  while (i > 0 && ok(i - 1)) --i;
  if (i == 0) return std::nullopt;
  return Bracket{line[i - 1].first, line[i].first};
}

std::vector<double> BoundarySearch::next() const {
  std::vector<double> wanted;
  if (stuck_) return wanted;
  for (const double end : {range_.low, range_.high}) {
    if (known_.count(end) == 0) wanted.push_back(end);
  }
  if (!wanted.empty() || boundary().kind != Boundary::Kind::kFound) return wanted;
  for (const Level level : {Level::kPasses, Level::kSurelyFails, Level::kSurelyPasses}) {
    const auto b = bracket(level);
    if (!b || std::abs(b->passing - b->failing) <= resolution_ * std::max(b->passing, b->failing))
      continue;
    const double value = range_.between(b->failing, b->passing);
    if (known_.count(value) == 0 &&
        std::find(wanted.begin(), wanted.end(), value) == wanted.end()) {
      wanted.push_back(value);
    }
  }
  return wanted;
}

/// How often what lies between two values is halved until it is narrow enough.
int BoundarySearch::halvings(double failing, double passing) const {
  double width = std::abs(passing - failing), enough = resolution_ * std::max(passing, failing);
  if (range_.logarithmic) {  // halved in its logarithm; 1 + resolution apart at the end
    width = std::abs(std::log(passing / failing));
    enough = -std::log1p(-resolution_);
  }
  if (range_.whole && !range_.logarithmic) enough = std::max(enough, 1.0);
  return width <= enough ? 0 : static_cast<int>(std::ceil(std::log2(width / enough) - 1e-9));
}

int BoundarySearch::expectedLeft() const {
  if (stuck_) return 0;
  int left = 0;
  for (const double end : {range_.low, range_.high}) left += known_.count(end) == 0 ? 1 : 0;
  if (left > 0) return left + halvings(range_.low, range_.high);
  if (boundary().kind != Boundary::Kind::kFound) return 0;
  std::set<std::pair<double, double>> between;  // levels that are not told apart yet share values
  for (const Level level : {Level::kPasses, Level::kSurelyFails, Level::kSurelyPasses}) {
    if (const auto b = bracket(level)) between.insert({b->failing, b->passing});
  }
  for (const auto& [failing, passing] : between) left += halvings(failing, passing);
  return left;
}

Boundary BoundarySearch::boundary() const {
  Boundary out;
  if (stuck_ || known_.empty()) {
    out.kind = Boundary::Kind::kUnknown;
    return out;
  }
  const RateEstimate first = known_.begin()->second, last = known_.rbegin()->second;
  const bool first_passes = first.rate() >= rate_, last_passes = last.rate() >= rate_;
  if (first_passes == last_passes) {
    out.kind = first_passes ? Boundary::Kind::kPassesEverywhere : Boundary::Kind::kPassesNowhere;
    return out;
  }
  out.rising = last_passes;
  const auto between = bracket(Level::kPasses);
  out.estimate = range_.logarithmic ? std::sqrt(between->failing * between->passing)
                                    : 0.5 * (between->failing + between->passing);
  const auto fails = bracket(Level::kSurelyFails), passes = bracket(Level::kSurelyPasses);
  if (fails) (out.rising ? out.low : out.high) = fails->failing;
  if (passes) (out.rising ? out.high : out.low) = passes->passing;
  return out;
}

Boundary boundaryIn(const std::map<double, RateEstimate>& rates, double rate) {
  const double low = rates.begin()->first, high = rates.rbegin()->first;
  BoundarySearch search({low, high, low > 0, false}, rate, 1);
  for (const auto& [value, estimate] : rates) search.tell(value, estimate);
  return search.boundary();
}

}  // namespace ballbot
