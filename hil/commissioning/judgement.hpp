#pragma once

#include <string>

#include "hil/bench_config.hpp"
#include "hil/commissioning/commissioning_task.hpp"
#include "hil/commissioning/hand_watch.hpp"
#include "hil/commissioning/pulse_watch.hpp"

namespace ballbot {

/// What commissioning makes of one task.
struct Judgement {
  enum class Verdict {
    kGood,
    kWrong,  ///< nothing more comes: something is not as configured
    kWait,   ///< not done yet
  };
  Verdict verdict = Verdict::kWait;
  std::string words;  ///< what is wrong, in which terms of the bench file, and what to look at
};

/// The robot in its stand: upright by the accelerometer, 1 g of it, a gyroscope that says nothing
/// turns, the arm at its zero marks.
Judgement judgeStand(const BenchConfig& config, const HandWatch& watch);

/// The base is upright again. @param watch  started and at rest
Judgement judgeUpright(const HandWatch& watch);

/// One joint turned by hand by a known angle: the drive that answers, the sign, both encoders'
/// counts. @param watch  started and at rest
Judgement judgeTurn(const BenchConfig& config, const CommissioningTask& task,
                    const HandWatch& watch);

/// The base tilted or turned by hand about a known axis: axes and signs of the gyroscope, and the
/// accelerometer against it. @param watch  started and at rest
Judgement judgeTilt(const CommissioningTask& task, const HandWatch& watch);

/// Low torque on one drive: its size, the joint's direction, the spring, and nothing elsewhere.
Judgement judgePulse(const BenchConfig& config, int drive, const PulseWatch& watch);

}  // namespace ballbot
