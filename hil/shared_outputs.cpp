#include "hil/shared_outputs.hpp"

#include <utility>

#include "hil/canopen_codec.hpp"

namespace ballbot {
namespace {

/// Dummies for so many bytes, the longest first.
void skip(std::vector<PdoEntry>& entries, int bytes) {
  constexpr std::pair<std::uint16_t, int> kDummies[] = {{0x0007, 4}, {0x0006, 2}, {0x0005, 1}};
  for (const auto& [index, width] : kDummies) {
    for (; bytes >= width; bytes -= width) {
      entries.push_back({{index, 0}, static_cast<std::uint8_t>(8 * width)});
    }
  }
}

}  // namespace

std::uint32_t sharedIdentifier(const BenchConfig& config, int bus) {
  for (const DriveConfig& d : config.drives) {
    if (d.bus == bus) return kCobRpdo[0] + static_cast<std::uint32_t>(d.node);
  }
  return 0;
}

std::uint8_t sharedOffset(const BenchConfig& config, const DriveConfig& drive) {
  std::uint8_t offset = 0;
  for (const DriveConfig& d : config.drives) {
    if (d.bus != drive.bus) continue;
    if (d.node == drive.node) break;
    offset = static_cast<std::uint8_t>(offset + config.outputs[0].bytes());
  }
  return offset;
}

PdoMapping sharedOutputs(const BenchConfig& config, const DriveConfig& drive) {
  std::vector<PdoEntry> entries;
  for (const DriveConfig& d : config.drives) {
    if (d.bus != drive.bus) continue;
    if (d.node != drive.node) {
      skip(entries, config.outputs[0].bytes());
      continue;
    }
    const std::vector<PdoEntry>& own = config.outputs[0].entries();
    entries.insert(entries.end(), own.begin(), own.end());
  }
  return PdoMapping(std::move(entries));
}

CanFrame sharedFrame(const BenchConfig& config, int bus) {
  CanFrame frame;
  frame.id = sharedIdentifier(config, bus);
  std::size_t bytes = 0;
  for (const DriveConfig& d : config.drives) {
    if (d.bus == bus) bytes += config.outputs[0].bytes();
  }
  frame.size = kFlexibleSizes[flexibleLengthCode(bytes)];
  return frame;
}

}  // namespace ballbot
