#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "metrics/tracking_metrics.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// Distance from its place within which the ball counts as returned [m].
constexpr double kReturnedDistance = 0.05;
/// The same for the end-effector [m].
constexpr double kEeReturnedDistance = 0.03;

/// How the robot takes pushes: how far the ball is driven from where it was when a push began, and
/// how long after the push it is back for good; the same of the end-effector; how far the arm moves
/// and how far the base leans against the push. "For good" means until the next push, a step of the
/// reference or the end.
///
/// Back is where the reference is, which may move, and in directions in which nothing is asked for
/// where the push found it. What a stand takes before the release is no push.
class PushMetrics {
 public:
  struct Interval {
    SimTime start, end;
    Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< horizontal part [N]
  };
  /// Pushes that overlap count as one, from the first start to the last end, and act with the sum
  /// of their impulses.
  /// @param release  what is before does not count
  explicit PushMetrics(std::vector<Interval> pushes, SimTime release = kSimStart);

  /// @param reference  at the truth's time; forces, truth and reference in one frame
  void add(const TruthFrame& truth, const PlaceReference& reference);

  /// Over all pushes that began within the run: largest_push_excursion_m; longest_push_return_s,
  /// absent if the ball did not come back; largest_push_ee_excursion_m and longest_push_ee_return_s
  /// likewise; largest_push_arm_excursion_rad; least_lean_against_push_deg, the smallest of the
  /// pushes' largest leans against them.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

 private:
  /// A point that is driven away from its home and comes back.
  struct Way {
    bool begun = false, over = false, away = false;
    Vector3 found_at = Vector3::Zero(), last_home = Vector3::Zero();
    Vector3 first_deviation = Vector3::Zero();
    double excursion = 0;
    SimTime last_away{};
    void add(SimTime t, const Vector3& position, const Vector3& reference,
             const Eigen::Array3d& asked, double returned_distance);
    double returnAfter(SimTime end) const;
  };
  struct Response {
    SimTime start, end;
    Eigen::Vector2d impulse = Eigen::Vector2d::Zero();  ///< [N s]
    bool begun = false, seen_to_its_end = false;
    Way ball, ee;
    ArmVector arm_home = ArmVector::Zero();
    Eigen::Vector2d lean_home = Eigen::Vector2d::Zero();
    double arm_excursion = 0, lean_against = 0;
  };
  std::vector<Response> responses_;
  bool started_ = false;
};

}  // namespace ballbot
