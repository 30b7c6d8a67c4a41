#include "fmi/fmu_types.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>

namespace ballbot {
namespace {

constexpr double kWhole = 9007199254740992.0;  // 2^53

template <typename T>
constexpr double low() {
  return static_cast<double>(std::numeric_limits<T>::lowest());
}
template <typename T>
constexpr double high() {
  return static_cast<double>(std::numeric_limits<T>::max());
}
template <typename T>
constexpr FmuType integer(const char* name, NativeType native) {
  return {name, ValueKind::kInteger, native, low<T>(), high<T>()};
}

constexpr FmuType kTypes[] = {
    {"Real", ValueKind::kReal, NativeType::kFloat64, low<double>(), high<double>()},
    {"Float64", ValueKind::kReal, NativeType::kFloat64, low<double>(), high<double>()},
    {"Float32", ValueKind::kReal, NativeType::kFloat32, low<float>(), high<float>()},
    integer<std::int32_t>("Integer", NativeType::kInt32),
    integer<std::int8_t>("Int8", NativeType::kInt8),
    integer<std::uint8_t>("UInt8", NativeType::kUInt8),
    integer<std::int16_t>("Int16", NativeType::kInt16),
    integer<std::uint16_t>("UInt16", NativeType::kUInt16),
    integer<std::int32_t>("Int32", NativeType::kInt32),
    integer<std::uint32_t>("UInt32", NativeType::kUInt32),
    {"Int64", ValueKind::kInteger, NativeType::kInt64, -kWhole, kWhole},
    {"UInt64", ValueKind::kInteger, NativeType::kUInt64, 0, kWhole},
    {"Boolean", ValueKind::kBoolean, NativeType::kBoolean, 0, 1},
    // 64 bits in FMI 3; FMI 2 has 32.
    {"Enumeration", ValueKind::kEnumeration, NativeType::kInt64, low<std::int32_t>(),
     high<std::int32_t>()},
};
constexpr FmuType kOtherType{"", ValueKind::kOther, NativeType::kNone, 0, 0};

}  // namespace

const FmuType& fmuType(const std::string& name) {
  const auto it = std::find_if(std::begin(kTypes), std::end(kTypes),
                               [&](const FmuType& t) { return name == t.name; });
  return it == std::end(kTypes) ? kOtherType : *it;
}

const char* toText(ValueKind kind) {
  switch (kind) {
    case ValueKind::kReal:
      return "a real number";
    case ValueKind::kInteger:
      return "a whole number";
    case ValueKind::kBoolean:
      return "true or false";
    case ValueKind::kEnumeration:
      return "an enumeration";
    case ValueKind::kOther:
      break;
  }
  return "no number";
}

bool fitsWithoutLoss(ValueKind from, ValueKind to) {
  if (from == ValueKind::kOther || to == ValueKind::kOther) return false;
  if (from == to || to == ValueKind::kReal) return true;
  return to == ValueKind::kInteger && from != ValueKind::kReal;
}

}  // namespace ballbot
