#include "hil/slcan_codec.hpp"

namespace ballbot {
namespace {

constexpr char kCarriageReturn = '\r';
constexpr char kLineFeed = '\n';
constexpr char kBell = '\a';
// LAWICEL: milliseconds of the minute; other firmware: microseconds.
constexpr std::size_t kTimestampDigits = 4, kLongTimestampDigits = 8;

int hexValue(char c) noexcept {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

/// Reads `count` hexadecimal digits; false if one of them is none.
bool readHex(const char* text, std::size_t count, std::uint32_t& value) noexcept {
  value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int digit = hexValue(text[i]);
    if (digit < 0) return false;
    value = value << 4 | static_cast<std::uint32_t>(digit);
  }
  return true;
}

}  // namespace

std::size_t encodeSlcan(const CanFrame& frame, std::array<char, kSlcanLineMax>& out) noexcept {
  if (!isValid(frame)) return 0;
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::size_t n = 0;
  const char kind = frame.remote ? 'r' : !frame.flexible ? 't' : frame.fast ? 'b' : 'd';
  out[n++] = frame.extended ? static_cast<char>(kind - 'a' + 'A') : kind;
  for (int shift = frame.extended ? 28 : 8; shift >= 0; shift -= 4) {
    out[n++] = kDigits[frame.id >> shift & 0xFU];
  }
  out[n++] = kDigits[frame.flexible ? flexibleLengthCode(frame.size) : frame.size];
  for (std::size_t i = 0; !frame.remote && i < frame.size; ++i) {
    out[n++] = kDigits[frame.data[i] >> 4];
    out[n++] = kDigits[frame.data[i] & 0xFU];
  }
  out[n++] = kCarriageReturn;
  return n;
}

SlcanParser::Item SlcanParser::take(char c) noexcept {
  if (c == kLineFeed && length_ == 0) return Item::kNone;  // some adapters end lines with CR LF
  if (c == kBell) {                                        // also ends a line that was cut short
    length_ = 0;
    too_long_ = false;
    return Item::kRefused;
  }
  if (c == kCarriageReturn) {
    const Item item = too_long_ ? Item::kMalformed : finishLine();
    length_ = 0;
    too_long_ = false;
    return item;
  }
  if (length_ < line_.size()) {
    line_[length_++] = c;
  } else {
    too_long_ = true;
  }
  return Item::kNone;
}

SlcanParser::Item SlcanParser::finishLine() noexcept {
  if (length_ == 0) return Item::kDone;
  switch (line_[0]) {
    case 't':
    case 'T':
    case 'r':
    case 'R':
    case 'd':
    case 'D':
    case 'b':
    case 'B':
      return parseFrame() ? Item::kFrame : Item::kMalformed;
    case 'z':
    case 'Z':
      return length_ == 1 ? Item::kDone : Item::kMalformed;
    case 'F':
      return parseStatus();
    case 'V':
    case 'v':
    case 'N':
      return length_ == 5 ? Item::kText : Item::kMalformed;
    default:
      return Item::kMalformed;
  }
}

bool SlcanParser::parseFrame() noexcept {
  const char kind = line_[0];
  CanFrame frame;
  frame.extended = kind < 'a';
  frame.remote = kind == 'r' || kind == 'R';
  frame.fast = kind == 'b' || kind == 'B';
  frame.flexible = frame.fast || kind == 'd' || kind == 'D';
  const std::size_t id_digits = frame.extended ? 8 : 3;
  if (length_ < 2 + id_digits) return false;
  if (!readHex(&line_[1], id_digits, frame.id)) return false;
  std::uint32_t length = 0;
  if (!readHex(&line_[1 + id_digits], 1, length)) return false;
  if (!frame.flexible && length > CanFrame::kMaxSize) return false;
  frame.size = frame.flexible ? kFlexibleSizes[length] : static_cast<std::uint8_t>(length);
  if (!isValid(frame)) return false;

  const std::size_t start = 2 + id_digits;
  const std::size_t data_digits = frame.remote ? 0 : 2U * frame.size;
  std::uint32_t value = 0;
  if (length_ < start + data_digits) return false;
  const std::size_t stamp = length_ - start - data_digits;
  if (stamp != 0 && stamp != kTimestampDigits && stamp != kLongTimestampDigits) return false;
  if (!readHex(&line_[start + data_digits], stamp, value)) return false;
  for (std::size_t i = 0; i < data_digits / 2; ++i) {
    if (!readHex(&line_[start + 2 * i], 2, value)) return false;
    frame.data[i] = static_cast<std::uint8_t>(value);
  }
  frame_ = frame;
  return true;
}

SlcanParser::Item SlcanParser::parseStatus() noexcept {
  std::uint32_t value = 0;
  if (length_ != 3 || !readHex(&line_[1], 2, value)) return Item::kMalformed;
  status_ = static_cast<std::uint8_t>(value);
  return Item::kStatus;
}

}  // namespace ballbot
