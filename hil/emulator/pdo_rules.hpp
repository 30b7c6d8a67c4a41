#pragma once

#include <cstdint>
#include <string>

#include "hil/can_frame.hpp"
#include "hil/emulator/object_dictionary.hpp"

namespace ballbot {

/// Objects 1400 to 1403 with 1600 to 1603, and 1800 to 1803 with 1A00 to 1A03 of an emulated node:
/// what may be written when (CiA 301, 7.5.2.35 to 38), and the packing of frames. RPDOs may skip
/// bytes by mapping the types 0005 to 0007.
class PdoRules {
 public:
  static constexpr int kPdoCount = 4;

  /// @param node_id for the default identifiers
  PdoRules(ObjectDictionary& dictionary, int node_id);

  /// Adds the objects of PDO `number` (0 to 3) with its default mapping: codes as in 1600.
  void addReceive(int number, std::initializer_list<std::uint32_t> mapping, int transmission);
  void addTransmit(int number, std::initializer_list<std::uint32_t> mapping, int transmission);

  /// Whether a PDO may have the 64 bytes of CAN FD.
  void setFlexible(bool on) { flexible_ = on; }
  /// Abort code for writing `value`, 0 if it may be written.
  std::uint32_t judge(std::uint16_t index, std::uint8_t sub, std::int64_t value) const;

  bool valid(bool transmit, int number) const;
  std::uint32_t identifier(bool transmit, int number) const;
  /// Whether a transmit PDO is also sent when a remote frame asks for it (bit 30 clear).
  bool onRequest(int number) const;
  int transmission(bool transmit, int number) const;
  /// Bytes of the frame: those of the objects, and on CAN FD what fills it up to a length that it
  /// has.
  int length(bool transmit, int number) const;

  CanFrame pack(int number) const;
  /// Writes the frame's values into the dictionary; values out of an object's limits are left out.
  void unpack(int number, const CanFrame& frame);

 private:
  void add(bool transmit, int number, std::initializer_list<std::uint32_t> mapping, int type);
  std::uint32_t judgeCommunication(bool transmit, int number, std::uint8_t sub,
                                   std::int64_t value) const;
  std::uint32_t judgeMapping(bool transmit, int number, std::uint8_t sub, std::int64_t value) const;
  std::uint32_t judgeEntry(bool transmit, std::uint32_t code) const;

  ObjectDictionary& dictionary_;
  int node_id_;
  bool flexible_ = false;
};

}  // namespace ballbot
