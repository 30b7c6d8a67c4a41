#pragma once

#include <vector>

#include <Eigen/Core>

namespace ballbot {

class ConfigReader;
class ConfigVisitor;

/// A vector over time, from where it starts and the moves made since: steps, ramps and circles.
/// Moves add up, so they may overlap.
template <int N>
class TimeSignal {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  explicit TimeSignal(const Vector& initial = Vector::Zero()) : initial_(initial) {}

  Vector value(double t) const { return value(t, t); }
  /// As known at `now` <= t: a step is an operator's command that nobody knows before it comes, so
  /// it counts from `now` = its time on; ramps and circles are planned and count ahead of time.
  Vector value(double t, double now) const;
  /// Time derivative; zero at a step.
  Vector rate(double t) const;

  /// A move that is made at once.
  struct Step {
    double at;  ///< [s]
    Vector by;
  };
  std::vector<Step> steps() const;
  /// Whether it ever changes.
  bool moves() const { return !moves_.empty(); }
  /// Times at which it may be at an extreme: its start, begin and end of each move, and 64 points
  /// on the first turn of a circle [s].
  std::vector<double> turningTimes() const;

  void step(double at, const Vector& by) { moves_.push_back({at, 0, by, 0, 0}); }
  void ramp(double at, double over, const Vector& by) { moves_.push_back({at, over, by, 0, 0}); }
  /// Around the point `radius` to the left of the start in the first two components, leaving in
  /// the second component's direction. Needs N >= 2.
  void circle(double at, double radius, double period, double turns);

  /// What is read adds its moves to those that are there.
  void describe(ConfigVisitor& v);

 private:
  void describeMove(ConfigVisitor& v);

  struct Move {
    double at, over;  ///< start and length [s]
    Vector by;
    double radius, period;  ///< a circle where radius is not 0
  };
  Vector initial_;
  std::vector<Move> moves_;
};

/// One number per component from a key that holds one number for all or a list of N.
template <int N>
Eigen::Matrix<double, N, 1> readVector(ConfigReader& in, const char* key, double low, double high);

/// Values that hold from a time on until the next: weights that switch tasks on and off.
template <int N>
class TimedWeight {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  explicit TimedWeight(const Vector& from_start = Vector::Zero())
      : changes_{{-1e300, from_start}} {}
  const Vector& value(double t) const { return value(t, t); }
  /// As known at `now` <= t: changes are commands, as steps of a reference are.
  const Vector& value(double t, double now) const;
  void change(double at, const Vector& weight);

  /// Of the mapping that has it: its weight, and the changes in order of time.
  /// @param least  of any weight at any time
  void describe(ConfigVisitor& v, double least = 0);

 private:
  struct Change {
    double at;
    Vector weight;
  };
  std::vector<Change> changes_;
};

}  // namespace ballbot
