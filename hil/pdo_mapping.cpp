#include "hil/pdo_mapping.hpp"

#include <cctype>
#include <cstdlib>

#include <fmt/format.h>

#include "core/error.hpp"
#include "hil/canopen_codec.hpp"

namespace ballbot {

void PdoField::put(CanFrame& frame, std::int64_t value) const noexcept {
  putLittleEndian(&frame.data[offset], static_cast<std::uint64_t>(value), bytes);
}
std::int64_t PdoField::getSigned(const CanFrame& frame) const noexcept {
  return ballbot::getSigned(&frame.data[offset], bytes);
}
std::uint64_t PdoField::getUnsigned(const CanFrame& frame) const noexcept {
  return getLittleEndian(&frame.data[offset], bytes);
}

PdoMapping::PdoMapping(std::vector<PdoEntry> entries) : entries_(std::move(entries)) {
  int bits = 0;
  for (const PdoEntry& entry : entries_) {
    if (entry.bits == 0 || entry.bits % 8 != 0 || entry.bits > 64) {
      throw InputError(fmt::format("PDO entry {}: {} bits, must be 8, 16, 24, 32 or 64",
                                   toText(entry.object), entry.bits));
    }
    bits += entry.bits;
  }
  if (bits > 8 * CanFrame::kMaxFlexibleSize) {
    throw InputError(fmt::format("a PDO of {} bits; at most 512 fit in a CAN FD frame", bits));
  }
  bytes_ = static_cast<std::uint8_t>(bits / 8);
}

PdoField PdoMapping::find(ObjectAddress object) const noexcept {
  std::uint8_t offset = 0;
  for (const PdoEntry& entry : entries_) {
    const auto bytes = static_cast<std::uint8_t>(entry.bits / 8);
    if (entry.object == object) return {offset, bytes};
    offset = static_cast<std::uint8_t>(offset + bytes);
  }
  return {};
}

ObjectAddress readObjectAddress(const std::string& text) {
  bool good = text.size() == 7 && text[4] == ':';
  for (std::size_t i = 0; good && i < text.size(); ++i) {
    good = i == 4 || std::isxdigit(static_cast<unsigned char>(text[i])) != 0;
  }
  if (!good) {
    throw InputError(fmt::format(
        "'{}' is no object; must be index and sub-index in hexadecimal digits, e.g. \"6076:00\"",
        text));
  }
  return {static_cast<std::uint16_t>(std::strtoul(text.c_str(), nullptr, 16)),
          static_cast<std::uint8_t>(std::strtoul(text.c_str() + 5, nullptr, 16))};
}

PdoEntry readPdoEntry(const std::string& text) {
  bool hex = text.size() == 8;
  for (const char c : text) hex = hex && std::isxdigit(static_cast<unsigned char>(c)) != 0;
  if (!hex) {
    throw InputError(fmt::format(
        "'{}' is no PDO entry; must be 8 hexadecimal digits: index, sub-index, bits, e.g. 60640020",
        text));
  }
  const unsigned long code = std::strtoul(text.c_str(), nullptr, 16);
  return {{static_cast<std::uint16_t>(code >> 16), static_cast<std::uint8_t>(code >> 8)},
          static_cast<std::uint8_t>(code)};
}

}  // namespace ballbot
