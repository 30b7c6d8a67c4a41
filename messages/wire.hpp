#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ballbot_msgs/actuator_command.hpp"
#include "ballbot_msgs/added_values.hpp"
#include "ballbot_msgs/sensor_frame.hpp"
#include "ballbot_msgs/state_estimate.hpp"
#include "ballbot_msgs/step_header.hpp"
#include "ballbot_msgs/step_reply.hpp"
#include "ballbot_msgs/step_request.hpp"
#include "ballbot_msgs/tick_digests.hpp"
#include "ballbot_msgs/truth_frame.hpp"

namespace ballbot {

using Bytes = std::vector<std::uint8_t>;

/// No message is longer, so that a message is one UDP packet and never a chain of fragments, of
/// which one may be lost and another doubled.
constexpr std::size_t kMaxMessageBytes = 1400;

/// Puts the checksum of an encoded message into it. Every message of this program begins with the
/// type's fingerprint (8 bytes) and its checksum (8 bytes), which is taken with those bytes zero.
/// @throw Error if the message is longer than kMaxMessageBytes.
void sealMessage(Bytes& encoded);

/// Is it whole? Says nothing about its type.
bool checksumHolds(const std::uint8_t* data, std::size_t size) noexcept;

/// The fingerprint a message begins with, i.e. of which type and definition it is; 0 if shorter.
std::int64_t fingerprint(const std::uint8_t* data, std::size_t size) noexcept;

/// A message as it goes over the wire and into the log. `out` keeps its memory between calls.
template <typename Message>
void encodeMessage(const Message& message, Bytes& out) {
  const int size = message.getEncodedSize();
  out.resize(static_cast<std::size_t>(size));
  message.encode(out.data(), 0, size);
  sealMessage(out);
}

/// Whether `size` bytes are what the lengths and counts written inside them say. The decoders that
/// lcm-gen writes believe those, and would read and allocate accordingly, so this comes first. A
/// type without such fields has one size; each of the others has a specialisation, and without one
/// only its messages with empty fields would be taken.
template <typename Message>
bool lengthsHold(const std::uint8_t*, std::size_t size) noexcept {
  static const auto fixed = static_cast<std::size_t>(Message{}.getEncodedSize());
  return size == fixed;
}
template <>
bool lengthsHold<ballbot_msgs::sensor_frame>(const std::uint8_t* data, std::size_t size) noexcept;
template <>
bool lengthsHold<ballbot_msgs::truth_frame>(const std::uint8_t* data, std::size_t size) noexcept;
template <>
bool lengthsHold<ballbot_msgs::state_estimate>(const std::uint8_t* data, std::size_t size) noexcept;
template <>
bool lengthsHold<ballbot_msgs::actuator_command>(const std::uint8_t* data,
                                                 std::size_t size) noexcept;
template <>
bool lengthsHold<ballbot_msgs::step_request>(const std::uint8_t* data, std::size_t size) noexcept;
template <>
bool lengthsHold<ballbot_msgs::step_reply>(const std::uint8_t* data, std::size_t size) noexcept;
template <>
bool lengthsHold<ballbot_msgs::added_values>(const std::uint8_t* data, std::size_t size) noexcept;
template <>
bool lengthsHold<ballbot_msgs::tick_digests>(const std::uint8_t* data, std::size_t size) noexcept;

/// Decodes bytes whose checksum holds. False, with `out` unspecified, if they are not exactly one
/// such message.
template <typename Message>
bool decodeWhole(const std::uint8_t* data, std::size_t size, Message& out) {
  return size <= kMaxMessageBytes && lengthsHold<Message>(data, size) &&
         out.decode(data, 0, static_cast<int>(size)) == static_cast<int>(size);
}

/// The same for bytes of which nothing is known yet; false also if they are damaged.
template <typename Message>
bool decodeMessage(const std::uint8_t* data, std::size_t size, Message& out) {
  return checksumHolds(data, size) && decodeWhole(data, size, out);
}

/// The header of a message of the step protocol, whichever version of this program sent it.
/// False if the checksum does not hold or the bytes are too short.
bool decodeHeader(const std::uint8_t* data, std::size_t size,
                  ballbot_msgs::step_header& out) noexcept;

/// Changes when the definition of any message does; both ends of a run must agree on it.
std::int64_t messageDigest();

}  // namespace ballbot
