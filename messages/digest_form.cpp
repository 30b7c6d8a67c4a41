#include "messages/digest_form.hpp"

#include <algorithm>
#include <cstddef>

#include "messages/frame_fields.hpp"

namespace ballbot {
namespace {

constexpr std::ptrdiff_t kFingerprintEnd = 8, kCountsBegin = 8 + 8 + 8 + 8;
constexpr std::ptrdiff_t kCountBytes = 4;

/// @param tag  the fingerprint that the type had when digests began
template <typename Message>
const Bytes& withoutCounts(const Bytes& encoded, std::uint64_t tag, Bytes& room) {
  using Sizes = FieldSizes<Message>;
  constexpr std::ptrdiff_t counts = (Sizes::kPerJoint > 0) + (Sizes::kPerCoordinate > 0);
  room.resize(encoded.size() - static_cast<std::size_t>(counts * kCountBytes));
  for (int i = 0; i < kFingerprintEnd; ++i) {
    room[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(tag >> (56 - 8 * i));
  }
  const auto body = std::copy(encoded.begin() + kFingerprintEnd, encoded.begin() + kCountsBegin,
                              room.begin() + kFingerprintEnd);
  std::copy(encoded.begin() + kCountsBegin + counts * kCountBytes, encoded.end(), body);
  sealMessage(room);
  return room;
}

}  // namespace

template <>
const Bytes& digestForm<ballbot_msgs::actuator_command>(const Bytes& encoded, Bytes& room) {
  return withoutCounts<ballbot_msgs::actuator_command>(encoded, 0x5c0959b963d1976a, room);
}
template <>
const Bytes& digestForm<ballbot_msgs::sensor_frame>(const Bytes& encoded, Bytes& room) {
  return withoutCounts<ballbot_msgs::sensor_frame>(encoded, 0x34b8ff0b95c45e24, room);
}
template <>
const Bytes& digestForm<ballbot_msgs::state_estimate>(const Bytes& encoded, Bytes& room) {
  return withoutCounts<ballbot_msgs::state_estimate>(encoded, 0x749064bc52ea3cb9, room);
}
template <>
const Bytes& digestForm<ballbot_msgs::truth_frame>(const Bytes& encoded, Bytes& room) {
  return withoutCounts<ballbot_msgs::truth_frame>(encoded, 0xb5c7270c08d5aaa2, room);
}

}  // namespace ballbot
