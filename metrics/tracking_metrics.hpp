#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/motion_reference.hpp"
#include "model/truth.hpp"

namespace ballbot {

/// How far ball and end-effector are from where they should be, over all times at which they should
/// be anywhere; only components that are asked for count.
class TrackingMetrics {
 public:
  /// @param from  times before do not count
  explicit TrackingMetrics(SimTime from) : from_(from) {}

  void add(const TruthFrame& truth, const PlaceReference& reference);

  /// rms_ and largest_ of ball_tracking_error_m and ee_tracking_error_m; absent where nothing was
  /// asked.
  std::map<std::string, double> values() const;
  static std::vector<std::string> names();

 private:
  struct Error {
    double square_integral = 0, time = 0, largest = 0;
    bool any = false;
    void add(double error, double dt);
  };
  SimTime from_, last_{};
  bool begun_ = false;
  Error ball_, ee_;
};

}  // namespace ballbot
