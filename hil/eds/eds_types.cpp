#include <fmt/format.h>

#include "hil/eds/data_sheet.hpp"

namespace ballbot {
namespace {

struct Type {
  int code, bits;
  bool is_signed;
  const char* name;
};
// CiA 301, table of data types.
constexpr Type kTypes[] = {
    {0x01, 8, false, "BOOLEAN"},          {0x02, 8, true, "INTEGER8"},
    {0x03, 16, true, "INTEGER16"},        {0x04, 32, true, "INTEGER32"},
    {0x05, 8, false, "UNSIGNED8"},        {0x06, 16, false, "UNSIGNED16"},
    {0x07, 32, false, "UNSIGNED32"},      {0x08, 32, false, "REAL32"},
    {0x09, 0, false, "VISIBLE_STRING"},   {0x0A, 0, false, "OCTET_STRING"},
    {0x0B, 0, false, "UNICODE_STRING"},   {0x0C, 48, false, "TIME_OF_DAY"},
    {0x0D, 48, false, "TIME_DIFFERENCE"}, {0x0F, 0, false, "DOMAIN"},
    {0x10, 24, true, "INTEGER24"},        {0x11, 64, false, "REAL64"},
    {0x12, 40, true, "INTEGER40"},        {0x13, 48, true, "INTEGER48"},
    {0x14, 56, true, "INTEGER56"},        {0x15, 64, true, "INTEGER64"},
    {0x16, 24, false, "UNSIGNED24"},      {0x18, 40, false, "UNSIGNED40"},
    {0x19, 48, false, "UNSIGNED48"},      {0x1A, 56, false, "UNSIGNED56"},
    {0x1B, 64, false, "UNSIGNED64"},
};

const Type* typeOf(int code) {
  for (const Type& type : kTypes) {
    if (type.code == code) return &type;
  }
  return nullptr;
}

}  // namespace

int EdsEntry::bits() const {
  const Type* type = typeOf(data_type);
  return type == nullptr ? 0 : type->bits;
}
bool EdsEntry::isSigned() const {
  const Type* type = typeOf(data_type);
  return type != nullptr && type->is_signed;
}

bool EdsEntry::inTransmitPdo() const {
  return mappable && readable() && access != EdsAccess::kReadWriteOutput;
}
bool EdsEntry::inReceivePdo() const {
  return mappable && writable() && access != EdsAccess::kReadWriteInput;
}

std::string edsTypeName(int data_type) {
  const Type* type = typeOf(data_type);
  return type == nullptr ? fmt::format("type {:04X}", data_type) : type->name;
}

const char* edsAccessName(EdsAccess access) {
  switch (access) {
    case EdsAccess::kConst:
      return "const";
    case EdsAccess::kReadOnly:
      return "ro";
    case EdsAccess::kWriteOnly:
      return "wo";
    case EdsAccess::kReadWrite:
      return "rw";
    case EdsAccess::kReadWriteInput:
      return "rwr";
    case EdsAccess::kReadWriteOutput:
      return "rww";
  }
  return "";
}

}  // namespace ballbot
