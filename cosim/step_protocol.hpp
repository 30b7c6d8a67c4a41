#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "ballbot_msgs/step_reply.hpp"
#include "ballbot_msgs/step_request.hpp"
#include "core/time.hpp"

namespace ballbot {

/// What both ends of the step protocol agree on; docs/protocol.md has the rules.
constexpr std::int32_t kProtocolVersion = 1;

/// Bytes of a saved state in one message.
constexpr std::size_t kChunkBytes = 700;
/// A saved state may not be larger: 1 MiB.
constexpr std::size_t kMaxStateBytes = std::size_t{1} << 20;
/// No step is longer: a calendar's events lie milliseconds apart, and a signal waits for the end of
/// the step under way.
constexpr SimDuration kLongestStep{1'000'000'000};
/// No time that a request speaks of is later: some thirty years, far from where time overflows.
constexpr SimTime kLatestTime{SimDuration{1'000'000'000'000'000'000}};
/// Words in a reply are cut here.
constexpr std::size_t kMaxTextBytes = 400;

/// "hello", "step", ...: the kind of a request, for messages to people.
const char* requestName(std::int8_t kind);

/// What arrived and was not acted on, by reason.
struct IgnoredMessages {
  std::int64_t damaged = 0;  ///< checksum wrong, or no message of this protocol
  std::int64_t foreign = 0;  ///< of another session
  std::int64_t old = 0;      ///< repeated or overtaken
  std::int64_t total() const { return damaged + foreign + old; }
};

}  // namespace ballbot
