#include "metrics/tracking_metrics.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {

void TrackingMetrics::Error::add(double error, double dt) {
  any = true;
  square_integral += dt * error * error;
  time += dt;
  largest = std::max(largest, error);
}

void TrackingMetrics::add(const TruthFrame& truth, const PlaceReference& reference) {
  if (truth.time < from_) return;
  const double dt = begun_ ? toSeconds(truth.time - last_) : 0;
  begun_ = true;
  last_ = truth.time;
  if (reference.ball_asked.any()) {
    const Eigen::Vector2d error = truth.state.segment<2>(kBallX) - reference.ball;
    ball_.add((error.array() * reference.ball_asked).matrix().norm(), dt);
  }
  if (reference.ee_asked.any()) {
    ee_.add(((truth.p_WE - reference.ee).array() * reference.ee_asked).matrix().norm(), dt);
  }
}

std::map<std::string, double> TrackingMetrics::values() const {
  std::map<std::string, double> m;
  const auto put = [&](const Error& e, const std::string& name) {
    if (!e.any) return;
    m["largest_" + name] = e.largest;
    if (e.time > 0) m["rms_" + name] = std::sqrt(e.square_integral / e.time);
  };
  put(ball_, "ball_tracking_error_m");
  put(ee_, "ee_tracking_error_m");
  return m;
}

std::vector<std::string> TrackingMetrics::names() {
  return {"rms_ball_tracking_error_m", "largest_ball_tracking_error_m", "rms_ee_tracking_error_m",
          "largest_ee_tracking_error_m"};
}

}  // namespace ballbot
