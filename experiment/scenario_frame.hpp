#pragma once

#include "cosim/log_reader.hpp"
#include "metrics/home_frame.hpp"

namespace ballbot {

/// Turns and moves the recorded truth into `home`, beside estimates and references.
void seeFromHome(const HomeFrame& home, RunLog& log);

}  // namespace ballbot
