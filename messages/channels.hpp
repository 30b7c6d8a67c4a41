#pragma once

#include <array>
#include <cstddef>

#include "model/added_signals.hpp"

namespace ballbot {

/// What is recorded of a run, in the order in which it happens within an event.
enum class Channel : std::size_t {
  kSensors,
  kTruth,
  kEstimate,
  kPlan,
  kCommand,
  kStateDigest,  ///< the participant's state, by its hash only
};
constexpr std::size_t kChannelCount = 6;

/// LCM channel of each in the log. The state's hash is no message of its own; its name is for
/// people.
constexpr std::array<const char*, kChannelCount> kChannelNames = {
    "SENSOR_FRAME", "TRUTH_FRAME",      "STATE_ESTIMATE",
    "PLAN_REPORT",  "ACTUATOR_COMMAND", "STATE_DIGEST"};
constexpr const char* kTickDigestsChannel = "TICK_DIGESTS";
/// Of what was added to the frames (docs/adding.md), in the order of AddedTo.
constexpr std::array<const char*, kAllAddedTo.size()> kAddedChannelNames = {
    "ADDED_SENSORS", "ADDED_TRUTH", "ADDED_ESTIMATE", "ADDED_PLAN"};
constexpr const char* addedChannelName(AddedTo frame) {
  return kAddedChannelNames[static_cast<std::size_t>(frame)];
}

constexpr const char* channelName(Channel channel) {
  return kChannelNames[static_cast<std::size_t>(channel)];
}

}  // namespace ballbot
