#include "hil/emulator/object_dictionary.hpp"

#include <algorithm>

namespace ballbot {

int sizeOf(OdType type) {
  switch (type) {
    case OdType::kI8:
    case OdType::kU8:
      return 1;
    case OdType::kI16:
    case OdType::kU16:
      return 2;
    case OdType::kI32:
    case OdType::kU32:
      return 4;
    case OdType::kText:
      break;
  }
  return 0;
}

bool isSigned(OdType type) {
  return type == OdType::kI8 || type == OdType::kI16 || type == OdType::kI32;
}

OdEntry& ObjectDictionary::variable(std::uint16_t index, const std::string& name, OdType type,
                                    OdAccess access, std::int64_t value) {
  objects_[index] = {name, OdShape::kVariable};
  OdEntry& entry = entries_[{index, std::uint8_t{0}}];
  entry.name = name;
  entry.type = type;
  entry.access = access;
  entry.value = entry.initial = value;
  return entry;
}

OdEntry& ObjectDictionary::text(std::uint16_t index, const std::string& name,
                                const std::string& value) {
  OdEntry& entry = variable(index, name, OdType::kText, OdAccess::kConst, 0);
  entry.text = value;
  return entry;
}

void ObjectDictionary::structure(std::uint16_t index, const std::string& name, OdShape shape) {
  variable(index, "Highest sub-index supported", OdType::kU8, OdAccess::kConst, 0);
  objects_[index] = {name, shape};
}

OdEntry& ObjectDictionary::sub(std::uint16_t index, std::uint8_t sub, const std::string& name,
                               OdType type, OdAccess access, std::int64_t value) {
  OdEntry& count = entries_[{index, std::uint8_t{0}}];
  count.value = count.initial = std::max<std::int64_t>(count.initial, sub);
  OdEntry& entry = entries_[{index, sub}];
  entry.name = name;
  entry.type = type;
  entry.access = access;
  entry.value = entry.initial = value;
  return entry;
}

OdEntry* ObjectDictionary::find(std::uint16_t index, std::uint8_t sub) {
  const auto it = entries_.find({index, sub});
  return it == entries_.end() ? nullptr : &it->second;
}
const OdEntry* ObjectDictionary::find(std::uint16_t index, std::uint8_t sub) const {
  const auto it = entries_.find({index, sub});
  return it == entries_.end() ? nullptr : &it->second;
}

std::int64_t ObjectDictionary::value(std::uint16_t index, std::uint8_t sub) const {
  return entries_.at({index, sub}).value;
}
void ObjectDictionary::set(std::uint16_t index, std::uint8_t sub, std::int64_t value) {
  entries_.at({index, sub}).value = value;
}

void ObjectDictionary::reset(std::uint16_t first, std::uint16_t last) {
  for (auto& [key, entry] : entries_) {
    if (key.first >= first && key.first <= last) entry.value = entry.initial;
  }
}

}  // namespace ballbot
