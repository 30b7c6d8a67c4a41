#include "estimator/frame_order.hpp"

namespace ballbot {
namespace {

/// What an estimator goes through without frames in one call; a robot that nobody watches for so
/// long has fallen.
constexpr SimDuration kLongestGap{1'000'000'000};
constexpr int kUntilBelieved = 10;

}  // namespace

FrameTime FrameOrder::judge(SimTime time) noexcept {
  if (started_ && time < newest_) return FrameTime::kLate;
  const bool ahead = started_ && time - newest_ > kLongestGap;
  if (ahead && ++ahead_ < kUntilBelieved) return FrameTime::kAhead;
  started_ = true;
  newest_ = time;
  ahead_ = 0;
  return ahead ? FrameTime::kLeap : FrameTime::kNext;
}

}  // namespace ballbot
