#include "messages/wire.hpp"

#include <cstring>

#include <fmt/format.h>

#include "ballbot_msgs/plan_report.hpp"
#include "ballbot_msgs/state_estimate.hpp"
#include "ballbot_msgs/step_reply.hpp"
#include "ballbot_msgs/step_request.hpp"
#include "ballbot_msgs/tick_digests.hpp"
#include "core/digest.hpp"
#include "core/error.hpp"

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

}  // namespace

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
      ballbot_msgs::step_request::getHash(), ballbot_msgs::step_reply::getHash(),
      ballbot_msgs::state_estimate::getHash(), ballbot_msgs::plan_report::getHash(),
      ballbot_msgs::tick_digests::getHash()};
  return static_cast<std::int64_t>(hash64(fingerprints, sizeof fingerprints));
}

}  // namespace ballbot
