#include "metrics/push_metrics.hpp"

#include <algorithm>

namespace ballbot {

PushMetrics::PushMetrics(std::vector<Interval> pushes) {
  std::sort(pushes.begin(), pushes.end(), [](const Interval& a, const Interval& b) { return a.start < b.start; });
  for (const Interval& push : pushes) {
    if (!responses_.empty() && push.start <= responses_.back().push.end) {
      responses_.back().push.end = std::max(responses_.back().push.end, push.end);
    } else {
      responses_.emplace_back();
      responses_.back().push = push;
    }
  }
}

void PushMetrics::add(const TruthFrame& truth) {
  // The newest push that has begun is the one the robot answers.
  auto it = std::find_if(responses_.rbegin(), responses_.rend(),
                         [&](const Response& r) { return r.push.start <= truth.time; });
  if (it == responses_.rend()) return;
  Response& r = *it;
  const Eigen::Vector2d position = truth.state.segment<2>(kBallX);
  if (!r.begun) {
    r.begun = true;
    r.home = position;
  }
  const double distance = (position - r.home).norm();
  r.excursion = std::max(r.excursion, distance);
  r.away = distance > kReturnedDistance;
  if (r.away) r.last_away = truth.time;
}

std::map<std::string, double> PushMetrics::values() const {
  std::map<std::string, double> m;
  double excursion = 0, longest = 0;
  bool any = false, all_back = true;
  for (const Response& r : responses_) {
    if (!r.begun) continue;
    any = true;
    excursion = std::max(excursion, r.excursion);
    all_back = all_back && !r.away;
    longest = std::max(longest, toSeconds(std::max(SimDuration::zero(), r.last_away - r.push.end)));
  }
  if (!any) return m;
  m["largest_push_excursion_m"] = excursion;
  if (all_back) m["longest_push_return_s"] = longest;
  return m;
}

std::vector<std::string> PushMetrics::names() { return {"largest_push_excursion_m", "longest_push_return_s"}; }

}  // namespace ballbot
