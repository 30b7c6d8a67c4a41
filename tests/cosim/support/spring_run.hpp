#pragma once

#include <string>

#include "cosim/recorder.hpp"
#include "cosim/schedule.hpp"
#include "cosim/step_master.hpp"
#include "tests/cosim/support/spring_controller.hpp"

namespace ballbot::testing_support {

/// A run of the spring with the paper's three rates: tracker 0.4 ms, estimator 2.5 ms, planner
/// 14 ms. Everything a test needs to step it against any participant.
struct SpringRun {
  explicit SpringRun(Participant& participant, SimDuration duration = SimDuration{100'000'000},
                     const std::string& log_path = "")
      : recorder(optionsFor(log_path)),
        master(participant, controller, calendar, &recorder, {kSimStart, kSimStart + duration}) {}

  /// Runs to the end and returns the trajectory digest.
  std::string finish() {
    master.run();
    recorder.close();
    return recorder.trajectoryDigest();
  }

  static RecorderOptions optionsFor(const std::string& log_path) {
    RecorderOptions options;
    options.log_path = log_path;
    return options;
  }

  EventCalendar calendar;
  TaskId tracker = calendar.addTask("tracker", SimDuration{400'000});
  TaskId estimator = calendar.addTask("estimator", SimDuration{2'500'000});
  TaskId planner = calendar.addTask("planner", SimDuration{14'000'000});
  SpringController controller{tracker, planner};
  Recorder recorder;
  StepMaster master;
};

}  // namespace ballbot::testing_support
