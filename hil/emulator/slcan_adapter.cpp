#include "hil/emulator/slcan_adapter.hpp"

#include <cctype>
#include <cstdlib>

#include <fmt/format.h>

namespace ballbot {
namespace {

constexpr char kOk = '\r', kError = '\a';
constexpr std::size_t kLongestCommand = 30, kLongestFlexibleCommand = 140;
// Bytes behind the length codes 9 to F of CAN FD.
constexpr int kLongSizes[] = {12, 16, 20, 24, 32, 48, 64};
constexpr int kStampModulus = 60'000;  // LAWICEL: milliseconds of the minute

bool allHex(const std::string& text) {
  for (const char c : text) {
    if (std::isxdigit(static_cast<unsigned char>(c)) == 0) return false;
  }
  return true;
}
unsigned long hexNumber(const std::string& text) { return std::strtoul(text.c_str(), nullptr, 16); }

}  // namespace

bool SlcanAdapter::take(char c, std::string& reply, CanFrame& sent) {
  if (c == '\n') return false;  // some terminals send it after CR
  if (c != '\r') {
    if (line_.size() <= (flexible_ ? kLongestFlexibleCommand : kLongestCommand)) line_ += c;
    return false;
  }
  const bool transmitted = act(reply, sent);
  line_.clear();
  return transmitted;
}

bool SlcanAdapter::act(std::string& reply, CanFrame& sent) {
  const auto answer = [&](bool good) {
    reply += good ? kOk : kError;
    return false;
  };
  if (line_.empty()) return answer(true);
  const std::string rest = line_.substr(1);
  switch (line_[0]) {
    case 'S':
      if (open_ || rest.size() != 1 || rest[0] < '0' || rest[0] > '8') return answer(false);
      rate_ = rest[0] - '0';
      return answer(true);
    case 's':  // bit timing registers: a real adapter's own, all of them accepted
      if (open_ || !allHex(rest) || rest.empty() || rest.size() > 6) return answer(false);
      rate_ = 8;
      return answer(true);
    case 'O':
    case 'L':
      // Opening twice is harmless and common among hosts.
      if (!rest.empty()) return answer(false);
      if (!open_) listen_only_ = line_[0] == 'L';
      open_ = true;
      return answer(true);
    case 'C':
      if (!rest.empty()) return answer(false);
      open_ = false;
      return answer(true);
    case 't':
    case 'T':
    case 'r':
    case 'R':
      return transmit(reply, sent);
    case 'd':
    case 'D':
    case 'b':
    case 'B':
      return flexible_ ? transmit(reply, sent) : answer(false);
    case 'Y':  // data bit rate in Mbit/s
      return answer(flexible_ && !open_ && rest.size() == 1 && rest[0] >= '1' && rest[0] <= '8');
    case 'F':
      if (!rest.empty() || !open_) return answer(false);
      reply += fmt::format("F{:02X}", status_);
      status_ = 0;
      return answer(true);
    case 'V':
      if (!rest.empty()) return answer(false);
      reply += "V1013";
      return answer(true);
    case 'N':
      if (!rest.empty()) return answer(false);
      reply += "NBALL";
      return answer(true);
    case 'Z':
      if (open_ || rest.size() != 1 || (rest[0] != '0' && rest[0] != '1')) return answer(false);
      stamps_ = rest[0] == '1';
      return answer(true);
    case 'M':
    case 'm':  // acceptance filter: everything passes here
      return answer(!open_ && rest.size() == 8 && allHex(rest));
    case 'W':
    case 'X':
    case 'U':
    case 'Q':
      return answer(!open_ && rest.size() == 1 && allHex(rest));
    default:
      return answer(false);
  }
}

bool SlcanAdapter::transmit(std::string& reply, CanFrame& sent) {
  const auto refuse = [&] {
    reply += kError;
    return false;
  };
  if (!open_ || listen_only_) return refuse();
  const char kind = line_[0];
  const bool extended = std::isupper(static_cast<unsigned char>(kind)) != 0;
  const bool remote = kind == 'r' || kind == 'R';
  const bool fast = kind == 'b' || kind == 'B';
  const bool flexible = fast || kind == 'd' || kind == 'D';
  const std::size_t digits = extended ? 8 : 3;
  if (line_.size() < digits + 2 || !allHex(line_.substr(1))) return refuse();
  int size = static_cast<int>(hexNumber(line_.substr(digits + 1, 1)));
  if (size > 8 && !flexible) return refuse();
  if (size > 8) size = kLongSizes[size - 9];
  const std::string payload = line_.substr(digits + 2);
  if (payload.size() != (remote ? 0U : 2U * static_cast<unsigned>(size))) return refuse();
  const unsigned long id = hexNumber(line_.substr(1, digits));
  if (id > (extended ? 0x1FFFFFFFUL : 0x7FFUL)) return refuse();

  sent = CanFrame{};
  sent.id = static_cast<std::uint32_t>(id);
  sent.extended = extended;
  sent.remote = remote;
  sent.flexible = flexible;
  sent.fast = fast;
  sent.size = static_cast<std::uint8_t>(size);
  for (std::size_t i = 0; i < payload.size() / 2; ++i) {
    sent.data[i] = static_cast<std::uint8_t>(hexNumber(payload.substr(2 * i, 2)));
  }
  reply += extended ? 'Z' : 'z';
  reply += kOk;
  return true;
}

void SlcanAdapter::show(const CanFrame& f, std::int64_t time_ms, std::string& reply) const {
  if (!open_) return;
  const char kind = f.remote ? 'r' : !f.flexible ? 't' : f.fast ? 'b' : 'd';
  int length = f.size;
  for (int i = 0; f.size > 8 && i < 7; ++i) {
    if (kLongSizes[i] == f.size) length = 9 + i;
  }
  if (f.extended) {
    reply += fmt::format("{}{:08X}{:X}", static_cast<char>(std::toupper(kind)), f.id, length);
  } else {
    reply += fmt::format("{}{:03X}{:X}", kind, f.id, length);
  }
  for (int i = 0; !f.remote && i < f.size; ++i) reply += fmt::format("{:02X}", f.data[i]);
  if (stamps_) reply += fmt::format("{:04X}", time_ms % kStampModulus);
  reply += kOk;
}

}  // namespace ballbot
