#include "hil/identify/stand.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr std::uint16_t kStand = 0x2020, kCurrent = 0x6078;
constexpr std::uint8_t kOutput = 1;

std::int64_t codeOf(Posture posture) {
  switch (posture) {
    case Posture::kBlocked:
      return 1;
    case Posture::kFree:
      return 2;
    case Posture::kBackDriven:
      return 3;
  }
  return 0;
}

}  // namespace

bool hasStand(SdoExchange& drive) { return drive.number(kStand, kOutput).value_or(0) != 0; }

void setStand(SdoExchange& drive, Posture posture) {
  if (drive.write(kStand, kOutput, codeOf(posture), 1)) return;
  throw LostParticipantError(
      "bench", fmt::format("identify: the test stand does not make its output {} (2020:01)",
                           toText(posture)));
}

bool hasCurrent(SdoExchange& drive) { return drive.number(kCurrent).has_value(); }

}  // namespace ballbot
