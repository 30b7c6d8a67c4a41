#pragma once

#include <cstdint>

#include "hil/can_frame.hpp"
#include "tests/hil/support/random_bytes.hpp"

namespace ballbot {

/// Frames that look like CANopen often enough to get somewhere: identifiers in use, payloads with
/// plausible beginnings, lengths cut or grown, the rest at random. Repeatable.
class CanopenNoise {
 public:
  explicit CanopenNoise(std::uint64_t seed) : random_(seed) {}

  int bus() { return static_cast<int>(random_.below(2)); }
  int drive() { return 1 + static_cast<int>(random_.below(6)); }

  /// As from a master to nodes 1 to 7.
  CanFrame toNode() {
    static constexpr std::uint32_t kBases[] = {0x600, 0x600, 0x600, 0x200, 0x300,
                                               0x400, 0x500, 0x000, 0x700, 0x080};
    CanFrame f = random_.frame();
    if (random_.below(4) == 0) return f;
    f.extended = f.remote = false;
    const std::uint32_t base = kBases[random_.below(10)];
    f.id = base == 0 || base == 0x080 ? base : base + 1 + random_.below(7);
    if (base == 0x600) {
      shapeSdo(f);
    } else if (base == 0x000 && f.size >= 2) {
      static constexpr std::uint8_t kCommands[] = {0x01, 0x02, 0x80, 0x81, 0x82, 0xFF};
      f.data[0] = kCommands[random_.below(6)];
      f.data[1] = static_cast<std::uint8_t>(random_.below(9));
    }
    return f;
  }

  /// As from nodes 1 to 7 to a master.
  CanFrame fromNode() {
    static constexpr std::uint32_t kBases[] = {0x080, 0x180, 0x280, 0x380, 0x480, 0x580, 0x700};
    CanFrame f = random_.frame();
    if (random_.below(4) == 0) return f;
    f.extended = f.remote = false;
    f.id = kBases[random_.below(7)] + 1 + random_.below(7);
    if ((f.id & 0x780U) == 0x580U) shapeSdo(f);
    return f;
  }

  /// "Enable operation" with a torque, for a drive that waits for it, in a form that no drive may
  /// follow: cut short, as a remote or extended frame, to nobody, or as a broken SDO.
  CanFrame spoiltEnable(int node) {
    CanFrame f;
    f.id = 0x200U + static_cast<unsigned>(node);
    f.size = 4;
    f.data = {0x0F, 0, random_.byte(), random_.byte()};
    switch (random_.below(5)) {
      case 0:
        f.size = static_cast<std::uint8_t>(random_.below(4));
        break;
      case 1:
        f.remote = true;
        break;
      case 2:
        f.extended = true;
        f.id |= random_.below(0x3FFFF) << 11;
        break;
      case 3:
        f.id = 0x200U + 8 + random_.below(0x70);
        break;
      default:
        f.id = 0x600U + static_cast<unsigned>(node);
        f.data = {0x2B, 0x40, 0x60, 0, 0x0F, 0, 0, 0};
        f.size = static_cast<std::uint8_t>(random_.below(8));  // an SDO has 8 bytes
    }
    return f;
  }

 private:
  /// A command byte of some service and an object that exists.
  void shapeSdo(CanFrame& f) {
    static constexpr std::uint8_t kCommands[] = {0x40, 0x2F, 0x2B, 0x23, 0x21, 0x60, 0x70,
                                                 0x00, 0x01, 0x80, 0x41, 0x43, 0x4B, 0x20};
    static constexpr std::uint16_t kObjects[] = {0x1000, 0x1008, 0x1017, 0x1016, 0x1400, 0x1600,
                                                 0x1800, 0x1A00, 0x6040, 0x6041, 0x6071, 0x6502};
    if (random_.below(8) != 0) f.size = 8;
    if (random_.below(8) != 0) f.data[0] = kCommands[random_.below(14)];
    if (random_.below(4) == 0) return;
    const std::uint16_t object = kObjects[random_.below(12)];
    f.data[1] = static_cast<std::uint8_t>(object & 0xFF);
    f.data[2] = static_cast<std::uint8_t>(object >> 8);
    f.data[3] = static_cast<std::uint8_t>(random_.below(6));
  }

  RandomBytes random_;
};

}  // namespace ballbot
