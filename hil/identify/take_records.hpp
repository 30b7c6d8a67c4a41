#pragma once

#include <atomic>
#include <vector>

#include "hil/bench_runner.hpp"
#include "hil/identify/excitation.hpp"

namespace ballbot {

/// The same bench for a drive whose response is not known yet: its torque is not compared with one.
/// @param with_current  the motor's current 6078 is mapped too, where there is room
BenchConfig forIdentification(BenchConfig config, bool with_current);

/// Excites one drive of a bench in one session, all others at zero torque, and records it. Torque,
/// rate, speed and angle stay within the bench's limits, and all of its checks are on.
/// @throw InputError if there is no way to turn within the drive's position limits;
///        LostParticipantError if the bench stops;
///        InterruptedError, with the drives off, once `stop` is set.
std::vector<Record> takeRecords(BenchRunner& runner, Posture posture, const ExcitationPlan& plan,
                                const std::atomic<bool>* stop = nullptr);

}  // namespace ballbot
