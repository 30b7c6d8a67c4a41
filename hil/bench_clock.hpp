#pragma once

#include "core/config_visitor.hpp"

namespace ballbot {

/// The keys of a bench file that both of its sides must share: the adapter's and the emulator's.
inline void describeClock(ConfigVisitor& v, SimDuration& cycle, bool& stepped) {
  v.duration(may("cycle_us", "from one SYNC to the next"), cycle, {200, 100'000});
  v.boolean(may("stepped", "SYNC is the clock, for emulated drives: the same bits on any machine"),
            stepped);
}

}  // namespace ballbot
