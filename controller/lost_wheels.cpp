#include "controller/lost_wheels.hpp"

#include <algorithm>

#include "core/config_visitor.hpp"

namespace ballbot {
namespace {

constexpr SimDuration kSoon = std::chrono::seconds(1);
constexpr int kMostBetrayals = 4;

}  // namespace

void WheelLoss::describe(ConfigVisitor& v) {
  v.boolean(may("counted_out",
                "whether a wheel that slips is left out of plans and gets no torque, until it "
                "grips again"),
            counted_out);
  v.duration(may("after_ms", "how long the estimator refuses a wheel until it counts as lost"),
             after, {1, 1e3});
  v.duration(may("trusted_after_ms",
                 "how long the estimator believes a lost wheel until it is counted on again; twice "
                 "as long each time that it slips again within a second"),
             trusted_after, {1, 1e4});
  drives.describe(v);
}

bool LostWheels::update(SimTime now, const WheelFlags& refused, const WheelFlags& dead) noexcept {
  if (!settings_.counted_out) return false;
  const WheelFlags before = lost_;
  if (ballbot::any(dead)) {
    lost_ = dead;
    dead_ = true;
    if (lost_ != before) ++losses_;
    return lost_ != before;
  }
  if (dead_) lost_ = {};  // it is tried again, or was never dead
  dead_ = false;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    if (refused[i] != refused_[i]) {
      refused_[i] = refused[i];
      since_[i] = now;
    }
    if (lost_[i] && !refused_[i] && now - since_[i] >= trustedAfter(i)) {
      lost_[i] = false;
      trusted_since_[i] = now;
    }
  }
  // Several at once are a state that fits nothing: then none is lost, and none was.
  if (std::count(refused_.begin(), refused_.end(), true) > 1) lost_ = {};
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    if (any() || !refused_[i] || now - since_[i] < settings_.after) continue;
    if (std::count(refused_.begin(), refused_.end(), true) > 1) break;
    lost_[i] = true;
    const bool again = trusted_since_[i] > SimTime{} && now - trusted_since_[i] < kSoon;
    betrayals_[i] = again ? std::min(betrayals_[i] + 1, kMostBetrayals) : 0;
    ++losses_;
  }
  return lost_ != before;
}

}  // namespace ballbot
