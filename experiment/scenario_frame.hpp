#pragma once

#include "cosim/log_reader.hpp"
#include "experiment/scenario.hpp"
#include "metrics/home_frame.hpp"

namespace ballbot {

/// Where a scenario's references and estimates are meant: W if its estimator is told the pose from
/// outside, else where the robot is put down. @throw InputError as the sections' own readers.
HomeFrame homeFrame(const Scenario& scenario);

/// Turns and moves the recorded truth into `home`, beside estimates and references.
void seeFromHome(const HomeFrame& home, RunLog& log);

}  // namespace ballbot
