#include "cosim/retransmission.hpp"

#include <algorithm>

namespace ballbot {

WallDuration RetransmissionTimer::wait(int tries) const {
  const WallDuration base =
      std::clamp<WallDuration>(smoothed_ + 4 * deviation_, kShortest, kLongest);
  return std::min<WallDuration>(kLongest, base * (1 << std::clamp(tries - 1, 0, 10)));
}

void RetransmissionTimer::measured(WallDuration round_trip) {
  if (!any_) {
    any_ = true;
    smoothed_ = round_trip;
    deviation_ = round_trip / 2;
    return;
  }
  const WallDuration error = round_trip - smoothed_;
  smoothed_ += error / 8;
  deviation_ += ((error < WallDuration{} ? -error : error) - deviation_) / 4;
}

}  // namespace ballbot
