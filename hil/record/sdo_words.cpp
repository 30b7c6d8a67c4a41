#include "hil/record/sdo_words.hpp"

#include <fmt/format.h>

#include "hil/canopen_codec.hpp"
#include "hil/record/object_words.hpp"

namespace ballbot {
namespace {

constexpr std::uint8_t kSdoSize = 8;
constexpr std::uint8_t kExpedited = 0x02, kSizeShown = 0x01;

std::string bare(ObjectAddress object) {
  const std::string name = nameOf(object);
  return name.empty() ? toText(object) : toText(object) + " " + name;
}

std::string segmentText(const CanFrame& f, const char* what) {
  const int unused = f.data[0] >> 1 & 0x07;
  std::string bytes;
  for (int i = 1; i < kSdoSize - unused; ++i) {
    bytes += fmt::format(" {:02X}", f.data[static_cast<std::size_t>(i)]);
  }
  return fmt::format("{}{}{}", what, bytes, (f.data[0] & 0x01) != 0 ? ", the last" : "");
}

/// Begin of a transfer that carries its value, or says how long it will be.
std::string carried(const CanFrame& f, ObjectAddress object, const DriveConfig* drive) {
  const std::uint8_t command = f.data[0];
  if ((command & kExpedited) == 0) {
    return fmt::format("{}, {} bytes to come", bare(object), getLittleEndian(&f.data[4], 4));
  }
  const std::size_t size = (command & kSizeShown) != 0 ? 4U - (command >> 2 & 0x03U) : 4U;
  return objectText(object, &f.data[4], size, drive);
}

}  // namespace

std::string sdoText(const CanFrame& f, bool to_server, const DriveConfig* drive) {
  if (f.size != kSdoSize || f.remote) return "no SDO: its length is not 8";
  const ObjectAddress object{static_cast<std::uint16_t>(getLittleEndian(&f.data[1], 2)), f.data[3]};
  const int service = f.data[0] >> 5;
  if (service == 4) {
    const auto code = static_cast<std::uint32_t>(getLittleEndian(&f.data[4], 4));
    return fmt::format("{} {}: {:08X} ({})", to_server ? "gives up" : "refused", bare(object), code,
                       sdoAbortText(code));
  }
  if (to_server) {
    switch (service) {
      case 0:
        return segmentText(f, "write, next bytes");
      case 1:
        return "write " + carried(f, object, drive);
      case 2:
        return "read " + bare(object);
      case 3:
        return "read, next bytes";
      default:
        return "unknown service";
    }
  }
  switch (service) {
    case 0:
      return segmentText(f, "next bytes");
    case 1:
      return "bytes taken";
    case 2:
      return carried(f, object, drive);
    case 3:
      return "written " + bare(object);
    default:
      return "unknown service";
  }
}

}  // namespace ballbot
