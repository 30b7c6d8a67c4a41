#pragma once

#include <cstdint>

#include "messages/wire.hpp"

namespace ballbot {

/// A message as the digest of a run takes it: without the counts that a message of a robot of any
/// size begins with, and under a tag of its own in the place of the fingerprint, so that a run
/// keeps its digest when the definition of a message changes and no number in it does.
/// @param encoded  by encodeMessage()
/// @param room     for what is not `encoded` itself; keeps its memory between calls
template <typename Message>
const Bytes& digestForm(const Bytes& encoded, Bytes& room) {
  (void)room;
  return encoded;
}
template <>
const Bytes& digestForm<ballbot_msgs::actuator_command>(const Bytes& encoded, Bytes& room);
template <>
const Bytes& digestForm<ballbot_msgs::sensor_frame>(const Bytes& encoded, Bytes& room);
template <>
const Bytes& digestForm<ballbot_msgs::state_estimate>(const Bytes& encoded, Bytes& room);
template <>
const Bytes& digestForm<ballbot_msgs::truth_frame>(const Bytes& encoded, Bytes& room);

}  // namespace ballbot
