#pragma once

#include <cmath>

#include "core/time.hpp"
#include "model/signals.hpp"

namespace ballbot {

inline SimTime ms(double t) { return simTimeFromNs(std::llround(1e6 * t)); }

/// Something for every part of the plant to do.
inline ActuatorCommand busyCommand() {
  ActuatorCommand c;
  c.torque << 0.4, -0.3, 0.2, 0.5, -2, 1;
  c.position << 0, 0, 0, 0, -0.6, 2.17;
  c.stiffness << 0.2, 0.2, 0.2, 8, 8, 8;
  c.damping << 0.02, 0.02, 0.02, 0.6, 0.6, 0.6;
  return c;
}

}  // namespace ballbot
