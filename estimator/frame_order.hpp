#pragma once

#include "core/time.hpp"

namespace ballbot {

enum class FrameTime {
  kNext,   ///< at or after the frame before, and not far from it
  kLate,   ///< before it
  kAhead,  ///< further from it than any gap that is gone through
  kLeap,   ///< likewise, but so many frames in a row say so that the gap was real
};

/// Judges the time of sensor frames, so that one wrong time neither makes an estimator go through
/// an hour of nothing in one call nor leaves it deaf to all that follow. Free of allocation.
class FrameOrder {
 public:
  FrameTime judge(SimTime time) noexcept;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.started_);
    visit(self.newest_);
    visit(self.ahead_);
  }

 private:
  bool started_ = false;
  SimTime newest_{};  ///< of the frames that were taken
  int ahead_ = 0;     ///< refused in a row
};

}  // namespace ballbot
