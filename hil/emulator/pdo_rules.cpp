#include "hil/emulator/pdo_rules.hpp"

#include <fmt/format.h>

#include "hil/emulator/sdo_server.hpp"

namespace ballbot {
namespace {

using namespace sdo_abort;

constexpr std::int64_t kInvalidBit = std::int64_t{1} << 31, kNoRtrBit = std::int64_t{1} << 30,
                       kExtendedBit = std::int64_t{1} << 29;
constexpr int kMaxMapped = 8, kMaxBits = 64, kMaxFlexibleBits = 512;

/// Types 0005 to 0007 as objects: bytes of an RPDO that are another node's (CiA 301, 7.4.7.1).
bool isDummy(std::uint32_t code) { return code >> 16 >= 0x0005 && code >> 16 <= 0x0007; }
int dummyBits(std::uint16_t index) { return 8 << (index - 0x0005); }

/// The shortest CAN FD frame that holds so many bytes.
int flexibleLength(int bytes) {
  for (const int length : {8, 12, 16, 20, 24, 32, 48, 64}) {
    if (bytes <= 8) return bytes;
    if (length >= bytes) return length;
  }
  return 64;
}

std::uint16_t communicationIndex(bool transmit, int number) {
  return static_cast<std::uint16_t>((transmit ? 0x1800 : 0x1400) + number);
}
std::uint16_t mappingIndex(bool transmit, int number) {
  return static_cast<std::uint16_t>((transmit ? 0x1A00 : 0x1600) + number);
}

}  // namespace

PdoRules::PdoRules(ObjectDictionary& dictionary, int node_id)
    : dictionary_(dictionary), node_id_(node_id) {}

void PdoRules::addReceive(int number, std::initializer_list<std::uint32_t> mapping, int type) {
  add(false, number, mapping, type);
}
void PdoRules::addTransmit(int number, std::initializer_list<std::uint32_t> mapping, int type) {
  add(true, number, mapping, type);
}

void PdoRules::add(bool transmit, int number, std::initializer_list<std::uint32_t> mapping,
                   int type) {
  const std::string name = fmt::format("{} {}", transmit ? "TPDO" : "RPDO", number + 1);
  const std::uint16_t parameters = communicationIndex(transmit, number);
  const std::int64_t base = (transmit ? 0x180 : 0x200) + 0x100 * number;
  const bool used = mapping.size() > 0;
  dictionary_.structure(parameters, name + " communication parameter", OdShape::kRecord);
  OdEntry& id =
      dictionary_.sub(parameters, 1, "COB-ID", OdType::kU32, OdAccess::kReadWrite,
                      (used ? 0 : kInvalidBit) + (transmit ? kNoRtrBit : 0) + base + node_id_);
  id.plus_node_id = true;
  dictionary_.sub(parameters, 2, "Transmission type", OdType::kU8, OdAccess::kReadWrite, type);
  if (transmit) {
    dictionary_.sub(parameters, 3, "Inhibit time", OdType::kU16, OdAccess::kReadWrite, 0);
  }
  dictionary_.sub(parameters, 5, "Event timer", OdType::kU16, OdAccess::kReadWrite, 0);

  const std::uint16_t map = mappingIndex(transmit, number);
  dictionary_.structure(map, name + " mapping parameter", OdShape::kRecord);
  int i = 0;
  for (const std::uint32_t code : mapping) {
    dictionary_.sub(map, static_cast<std::uint8_t>(++i), fmt::format("Mapped object {}", i),
                    OdType::kU32, OdAccess::kReadWrite, code);
  }
  while (i < kMaxMapped) {
    dictionary_.sub(map, static_cast<std::uint8_t>(++i), fmt::format("Mapped object {}", i),
                    OdType::kU32, OdAccess::kReadWrite, 0);
  }
  OdEntry* count = dictionary_.find(map, 0);
  count->name = "Number of mapped objects";
  count->access = OdAccess::kReadWrite;
  count->value = count->initial = static_cast<std::int64_t>(mapping.size());
}

bool PdoRules::valid(bool transmit, int number) const {
  return (dictionary_.value(communicationIndex(transmit, number), 1) & kInvalidBit) == 0;
}
std::uint32_t PdoRules::identifier(bool transmit, int number) const {
  return static_cast<std::uint32_t>(dictionary_.value(communicationIndex(transmit, number), 1) &
                                    0x7FF);
}
bool PdoRules::onRequest(int number) const {
  return (dictionary_.value(communicationIndex(true, number), 1) & kNoRtrBit) == 0;
}
int PdoRules::transmission(bool transmit, int number) const {
  return static_cast<int>(dictionary_.value(communicationIndex(transmit, number), 2));
}

int PdoRules::length(bool transmit, int number) const {
  const std::uint16_t map = mappingIndex(transmit, number);
  int bits = 0;
  for (int i = 1; i <= dictionary_.value(map); ++i) {
    bits += static_cast<int>(dictionary_.value(map, static_cast<std::uint8_t>(i)) & 0xFF);
  }
  return flexible_ ? flexibleLength(bits / 8) : bits / 8;
}

std::uint32_t PdoRules::judge(std::uint16_t index, std::uint8_t sub, std::int64_t value) const {
  const int number = index & 0x1FF;
  switch (index & 0xFE00) {
    case 0x1400:
      return judgeCommunication(false, number, sub, value);
    case 0x1600:
      return judgeMapping(false, number, sub, value);
    case 0x1800:
      return judgeCommunication(true, number, sub, value);
    case 0x1A00:
      return judgeMapping(true, number, sub, value);
    default:
      return kNone;
  }
}

std::uint32_t PdoRules::judgeCommunication(bool transmit, int number, std::uint8_t sub,
                                           std::int64_t value) const {
  const bool in_use = valid(transmit, number);
  if (sub == 1) {
    if ((value & kExtendedBit) != 0) return kValue;  // 11-bit identifiers only
    const std::int64_t id = value & 0x7FF;
    // Identifiers that CiA 301 keeps for other things (table of restricted COB-IDs).
    const bool restricted = id <= 0x07F || (id >= 0x101 && id <= 0x180) ||
                            (id >= 0x581 && id <= 0x5FF) || (id >= 0x601 && id <= 0x67F) ||
                            id >= 0x6E0;
    if ((value & kInvalidBit) == 0 && restricted) return kValue;
    if ((value & 0x1FFFF800) != 0) return kValue;
    // A PDO in use is first switched off, then given another identifier.
    const std::int64_t now = dictionary_.value(communicationIndex(transmit, number), 1);
    if (in_use && (value & kInvalidBit) == 0 && (value & 0x7FF) != (now & 0x7FF)) return kValue;
    return kNone;
  }
  if (sub == 2) {
    if (value > 240 && value < 254) return kValue;  // reserved, and sending on request only
    return kNone;
  }
  if (sub == 3 && in_use) return kUnsupported;
  return kNone;
}

std::uint32_t PdoRules::judgeMapping(bool transmit, int number, std::uint8_t sub,
                                     std::int64_t value) const {
  const std::uint16_t map = mappingIndex(transmit, number);
  if (valid(transmit, number)) return kUnsupported;
  if (sub != 0) {
    if (dictionary_.value(map) != 0) return kUnsupported;
    return judgeEntry(transmit, static_cast<std::uint32_t>(value));
  }
  if (value > kMaxMapped) return kPdoLength;
  int bits = 0;
  for (int i = 1; i <= value; ++i) {
    const auto code =
        static_cast<std::uint32_t>(dictionary_.value(map, static_cast<std::uint8_t>(i)));
    if (code == 0) return kNoObject;
    bits += static_cast<int>(code & 0xFF);
  }
  return bits > (flexible_ ? kMaxFlexibleBits : kMaxBits) ? kPdoLength : kNone;
}

std::uint32_t PdoRules::judgeEntry(bool transmit, std::uint32_t code) const {
  if (code == 0) return kNone;  // an entry not in use
  const auto index = static_cast<std::uint16_t>(code >> 16);
  const auto sub = static_cast<std::uint8_t>(code >> 8);
  if (isDummy(code)) {
    return transmit                                                        ? kNotMappable
           : static_cast<int>(code & 0xFF) == dummyBits(index) && sub == 0 ? kNone
                                                                           : kPdoLength;
  }
  if (!dictionary_.hasIndex(index)) return kNoObject;
  const OdEntry* entry = dictionary_.find(index, sub);
  if (entry == nullptr) return kNoSub;
  if (!entry->mappable || (transmit ? !entry->readable() : !entry->writable())) return kNotMappable;
  if (static_cast<int>(code & 0xFF) != 8 * sizeOf(entry->type)) return kPdoLength;
  return kNone;
}

CanFrame PdoRules::pack(int number) const {
  const std::uint16_t map = mappingIndex(true, number);
  CanFrame frame;
  frame.id = identifier(true, number);
  for (int i = 1; i <= dictionary_.value(map); ++i) {
    const std::int64_t code = dictionary_.value(map, static_cast<std::uint8_t>(i));
    std::int64_t value = dictionary_.value(static_cast<std::uint16_t>(code >> 16),
                                           static_cast<std::uint8_t>(code >> 8 & 0xFF));
    for (std::int64_t bits = code & 0xFF; bits > 0; bits -= 8, value >>= 8) {
      frame.data[frame.size++] = static_cast<std::uint8_t>(value & 0xFF);
    }
  }
  frame.size = static_cast<std::uint8_t>(length(true, number));
  return frame;
}

void PdoRules::unpack(int number, const CanFrame& frame) {
  const std::uint16_t map = mappingIndex(false, number);
  std::size_t at = 0;
  for (int i = 1; i <= dictionary_.value(map); ++i) {
    const std::int64_t code = dictionary_.value(map, static_cast<std::uint8_t>(i));
    if (isDummy(static_cast<std::uint32_t>(code))) {
      at += static_cast<std::size_t>(code & 0xFF) / 8;
      continue;
    }
    OdEntry* entry = dictionary_.find(static_cast<std::uint16_t>(code >> 16),
                                      static_cast<std::uint8_t>(code >> 8 & 0xFF));
    const int bits = static_cast<int>(code & 0xFF);
    std::int64_t value = 0;
    for (int b = 0; b < bits; b += 8) value += static_cast<std::int64_t>(frame.data[at++]) << b;
    if (isSigned(entry->type) && (value >> (bits - 1) & 1) != 0) value -= std::int64_t{1} << bits;
    if ((entry->high && value > *entry->high) || (entry->low && value < *entry->low)) continue;
    entry->value = value;
  }
}

}  // namespace ballbot
