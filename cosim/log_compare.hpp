#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/time.hpp"
#include "messages/channels.hpp"

namespace ballbot {

/// The first place where two runs differ.
struct RunDifference {
  std::int64_t tick = 0;
  SimTime time{};
  /// First channel, in the order of a tick, that differs; none where one run has an event that the
  /// other has not.
  std::optional<Channel> channel;
  /// In words: "tick 1234 at 0.493600 s: SENSOR_FRAME differs".
  std::string text;
};

/// Where two runs begin: at the same event, or one later, as a run does that continues another.
enum class RunBegin { kSame, kMayBeLater };

/// Compares the logs of two runs event by event at full rate, whatever they kept of the messages.
/// Nothing if they are identical as far as both reach and end together; where one may begin later,
/// what the other did before is passed over.
/// @throw InputError if a log cannot be read, is damaged (saying where) or holds no digests.
std::optional<RunDifference> compareLogs(const std::string& path_a, const std::string& path_b,
                                         RunBegin begin = RunBegin::kSame);

}  // namespace ballbot
