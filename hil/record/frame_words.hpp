#pragma once

#include <string>

#include "hil/bench_config.hpp"
#include "hil/recorder/flight_recorder.hpp"

namespace ballbot {

/// A frame in words.
struct FrameWords {
  int node = 0;     ///< 0: none in particular
  std::string who;  ///< whose frame it is by its identifier: "wheel 2", "IMU", "all nodes"
  std::string
      service;  ///< "SYNC", "NMT", "EMCY", "TPDO1", "RPDO1", "SDO request", "heartbeat", ...
  std::string meaning;  ///< "6041:00 statusword 1637 (operation enabled), 6077:00 torque 0.52 Nm"
};

/// Reads a frame as the bench's configuration says: mapping, scaling, names. Values of drives are
/// SI at the joint. A frame that came though only the master may send it is said to be somebody
/// else's.
FrameWords wordsOf(const RecordedFrame& frame, const BenchConfig& config);

}  // namespace ballbot
