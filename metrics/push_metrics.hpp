#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// Distance from its place within which the ball counts as returned [m].
constexpr double kReturnedDistance = 0.05;

/// How the robot takes pushes: how far the ball is driven from where it was when a push began, and
/// how long after the push it is back for good. "For good" means until the next push or the end.
class PushMetrics {
 public:
  struct Interval {
    SimTime start, end;
  };
  /// Pushes that overlap count as one, from the first start to the last end.
  explicit PushMetrics(std::vector<Interval> pushes);

  void add(const TruthFrame& truth);

  /// largest_push_excursion_m; longest_push_return_s, absent if the ball did not come back.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

 private:
  struct Response {
    Interval push;
    bool begun = false;
    Eigen::Vector2d home = Eigen::Vector2d::Zero();
    double excursion = 0;
    SimTime last_away{};
    bool away = false;
  };
  std::vector<Response> responses_;
};

}  // namespace ballbot
