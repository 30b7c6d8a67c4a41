#include "messages/wire.hpp"

#include <cstring>

#include <fmt/format.h>

#include "ballbot_msgs/step_reply.hpp"
#include "ballbot_msgs/step_request.hpp"
#include "ballbot_msgs/tick_digests.hpp"
#include "core/digest.hpp"
#include "core/error.hpp"
#include "messages/frame_fields.hpp"
#include "model/state.hpp"

namespace ballbot {
namespace {

constexpr std::size_t kFingerprintBytes = 8;
constexpr std::size_t kChecksumEnd = 16;

// Of everything but the eight bytes the checksum itself stands in.
std::uint64_t checksum(const std::uint8_t* data, std::size_t size) noexcept {
  const std::uint64_t body = hash64(data + kChecksumEnd, size - kChecksumEnd);
  std::uint64_t both[2] = {0, body};
  std::memcpy(&both[0], data, kFingerprintBytes);
  return hash64(both, sizeof both);
}

std::uint64_t readBigEndian(const std::uint8_t* at) noexcept {
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i) value = value << 8 | at[i];
  return value;
}

/// Bytes of a message inside another, where it has no fingerprint; without those of arrays that its
/// own counts say the size of.
template <typename Message>
std::size_t innerBytes() noexcept {
  static const auto bytes = static_cast<std::size_t>(Message{}._getEncodedSizeNoHash());
  return bytes;
}

/// Walks over an encoded message: field by field, or by the count that stands before an array.
class Walk {
 public:
  Walk(const std::uint8_t* data, std::size_t size) noexcept : at_(data), left_(size) {}

  Walk& skip(std::size_t bytes) noexcept {
    holds_ = holds_ && bytes <= left_;
    if (!holds_) return *this;
    at_ += bytes;
    left_ -= bytes;
    return *this;
  }
  /// A count from `least` on, of elements of so many bytes each.
  Walk& counted(std::size_t element_bytes, std::int32_t least = 0) noexcept {
    const std::int32_t count = number();
    holds_ = holds_ && count >= least && static_cast<std::size_t>(count) <= left_ / element_bytes;
    return holds_ ? skip(static_cast<std::size_t>(count) * element_bytes) : *this;
  }
  /// A text: its length counts the zero at its end, so it is never 0.
  Walk& text() noexcept {
    counted(1, 1);
    holds_ = holds_ && at_[-1] == 0;
    return *this;
  }
  /// A message with a frame, without its fingerprint: its counts say how many numbers it has.
  template <typename Message>
  Walk& frame() noexcept {
    using Sizes = FieldSizes<Message>;
    constexpr std::size_t counts = (Sizes::kPerJoint > 0) + (Sizes::kPerCoordinate > 0);
    std::size_t numbers = 0;
    skip(kFrameHead);
    if (Sizes::kPerJoint > 0) numbers += Sizes::kPerJoint * count(kMaxWheels + kMaxArmJoints);
    if (Sizes::kPerCoordinate > 0) numbers += Sizes::kPerCoordinate * count(kArm1 + kMaxArmJoints);
    return skip(innerBytes<Message>() - kFrameHead - counts * kCountBytes + 8 * numbers);
  }
  /// As many of them as the count before them says.
  template <typename Message>
  Walk& frames() noexcept {
    for (std::size_t left = count(kMaxMessageBytes / kFrameHead); left > 0 && holds_; --left) {
      frame<Message>();
    }
    return *this;
  }
  bool ends() const noexcept { return holds_ && left_ == 0; }

  static constexpr std::size_t kCountBytes = 4;

 private:
  static constexpr std::size_t kFrameHead = 8 + 8 + 8;  ///< checksum, tick, sim_time_ns

  std::int32_t number() noexcept {
    const std::uint8_t* const at = at_;
    if (!skip(kCountBytes).holds_) return 0;
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < kCountBytes; ++i) bits = bits << 8 | at[i];
    return static_cast<std::int32_t>(bits);
  }
  /// A count that stands before what it counts, from 0 to `most`.
  std::size_t count(std::int32_t most) noexcept {
    const std::int32_t count = number();
    holds_ = holds_ && count >= 0 && count <= most;
    return holds_ ? static_cast<std::size_t>(count) : 0;
  }

  const std::uint8_t* at_;
  std::size_t left_;
  bool holds_ = true;
};

}  // namespace

template <>
bool lengthsHold<ballbot_msgs::sensor_frame>(const std::uint8_t* data, std::size_t size) noexcept {
  return Walk(data, size).skip(kFingerprintBytes).frame<ballbot_msgs::sensor_frame>().ends();
}
template <>
bool lengthsHold<ballbot_msgs::truth_frame>(const std::uint8_t* data, std::size_t size) noexcept {
  return Walk(data, size).skip(kFingerprintBytes).frame<ballbot_msgs::truth_frame>().ends();
}
template <>
bool lengthsHold<ballbot_msgs::state_estimate>(const std::uint8_t* data,
                                               std::size_t size) noexcept {
  return Walk(data, size).skip(kFingerprintBytes).frame<ballbot_msgs::state_estimate>().ends();
}
template <>
bool lengthsHold<ballbot_msgs::actuator_command>(const std::uint8_t* data,
                                                 std::size_t size) noexcept {
  return Walk(data, size).skip(kFingerprintBytes).frame<ballbot_msgs::actuator_command>().ends();
}

template <>
bool lengthsHold<ballbot_msgs::step_request>(const std::uint8_t* data, std::size_t size) noexcept {
  return Walk(data, size)
      .skip(kFingerprintBytes + innerBytes<ballbot_msgs::step_header>())
      .skip(8 + 8 + 8 + 8)  // message_digest, config_digest, time_ns, step_ns
      .frame<ballbot_msgs::actuator_command>()
      .skip(4 + 4)  // blob_size, blob_offset
      .counted(1)   // chunk
      .ends();
}

template <>
bool lengthsHold<ballbot_msgs::step_reply>(const std::uint8_t* data, std::size_t size) noexcept {
  return Walk(data, size)
      .skip(kFingerprintBytes + innerBytes<ballbot_msgs::step_header>())
      .skip(8 + 1 + 1)  // server, status, exit_code
      .text()
      .skip(8 + 8)  // time, digest
      .frame<ballbot_msgs::sensor_frame>()
      .frames<ballbot_msgs::truth_frame>()
      .counted(8)   // added
      .counted(8)   // truth_added
      .skip(4 + 4)  // blob_size, blob_offset
      .counted(1)   // chunk
      .ends();
}

template <>
bool lengthsHold<ballbot_msgs::added_values>(const std::uint8_t* data, std::size_t size) noexcept {
  return Walk(data, size)
      .skip(kChecksumEnd + 8 + 8)  // tick, sim_time_ns
      .text()
      .text()
      .text()
      .counted(8)  // value
      .ends();
}

template <>
bool lengthsHold<ballbot_msgs::tick_digests>(const std::uint8_t* data, std::size_t size) noexcept {
  return Walk(data, size)
      .skip(kChecksumEnd + 8 + 8)  // first_tick, first_time_ns
      .counted(4)
      .counted(4)
      .ends();
}

void sealMessage(Bytes& encoded) {
  if (encoded.size() > kMaxMessageBytes) {
    throw Error(ExitCode::kBadInput,
                fmt::format("a message of {} bytes is too long, at most {} fit", encoded.size(),
                            kMaxMessageBytes));
  }
  const std::uint64_t sum = checksum(encoded.data(), encoded.size());
  for (std::size_t i = 0; i < 8; ++i) {
    encoded[kFingerprintBytes + i] = static_cast<std::uint8_t>(sum >> (56 - 8 * i));
  }
}

bool checksumHolds(const std::uint8_t* data, std::size_t size) noexcept {
  if (size < kChecksumEnd || size > kMaxMessageBytes) return false;
  return readBigEndian(data + kFingerprintBytes) == checksum(data, size);
}

std::int64_t fingerprint(const std::uint8_t* data, std::size_t size) noexcept {
  return size < kFingerprintBytes ? 0 : static_cast<std::int64_t>(readBigEndian(data));
}

bool decodeHeader(const std::uint8_t* data, std::size_t size,
                  ballbot_msgs::step_header& out) noexcept {
  if (!checksumHolds(data, size)) return false;
  return out._decodeNoHash(data, kFingerprintBytes, static_cast<int>(size - kFingerprintBytes)) > 0;
}

std::int64_t messageDigest() {
  const std::int64_t fingerprints[] = {
      ballbot_msgs::step_request::getHash(),   ballbot_msgs::step_reply::getHash(),
      ballbot_msgs::state_estimate::getHash(), ballbot_msgs::plan_report::getHash(),
      ballbot_msgs::tick_digests::getHash(),   ballbot_msgs::added_values::getHash()};
  return static_cast<std::int64_t>(hash64(fingerprints, sizeof fingerprints));
}

}  // namespace ballbot
