#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <vector>

#include "ballbot_msgs/step_header.hpp"

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

/// Decodes bytes whose checksum holds. False, with `out` unspecified, if they are not exactly one
/// such message.
template <typename Message>
bool decodeWhole(const std::uint8_t* data, std::size_t size, Message& out) noexcept {
  try {
    return out.decode(data, 0, static_cast<int>(size)) == static_cast<int>(size);
  } catch (const std::exception&) {
    return false;  // a length inside that no memory could hold
  }
}

/// The same for bytes of which nothing is known yet; false also if they are damaged.
template <typename Message>
bool decodeMessage(const std::uint8_t* data, std::size_t size, Message& out) noexcept {
  return checksumHolds(data, size) && decodeWhole(data, size, out);
}

/// The header of a message of the step protocol, whichever version of this program sent it.
/// False if the checksum does not hold or the bytes are too short.
bool decodeHeader(const std::uint8_t* data, std::size_t size,
                  ballbot_msgs::step_header& out) noexcept;

/// Changes when the definition of any message does; both ends of a run must agree on it.
std::int64_t messageDigest();

}  // namespace ballbot
