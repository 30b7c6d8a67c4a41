#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/can_frame.hpp"
#include "hil/sdo_client.hpp"

namespace ballbot {

/// One object in a PDO. Whole bytes only: the objects of drives are 8, 16 and 32 bits wide.
struct PdoEntry {
  ObjectAddress object;
  std::uint8_t bits = 0;

  /// As sub-index 1..8 of 1600 or 1A00 holds it.
  std::uint32_t code() const noexcept {
    return static_cast<std::uint32_t>(object.index) << 16 |
           static_cast<std::uint32_t>(object.sub) << 8 | bits;
  }
};

/// Where an object lies in a PDO; `bytes` is 0 if it is not in it.
struct PdoField {
  std::uint8_t offset = 0, bytes = 0;

  explicit operator bool() const noexcept { return bytes != 0; }
  void put(CanFrame& frame, std::int64_t value) const noexcept;
  std::int64_t getSigned(const CanFrame& frame) const noexcept;
  std::uint64_t getUnsigned(const CanFrame& frame) const noexcept;
};

/// Contents of one PDO.
class PdoMapping {
 public:
  PdoMapping() = default;
  /// @throw InputError if an entry is not 8, 16, 24, 32 or 64 bits wide or all are longer than a
  /// frame of
  ///        CAN FD.
  explicit PdoMapping(std::vector<PdoEntry> entries);

  const std::vector<PdoEntry>& entries() const noexcept { return entries_; }
  /// Bytes of the objects.
  std::uint8_t bytes() const noexcept { return bytes_; }
  /// Bytes of the frame that carries them: frames of CAN FD have some lengths only.
  std::uint8_t frameBytes() const noexcept { return kFlexibleSizes[flexibleLengthCode(bytes_)]; }
  PdoField find(ObjectAddress object) const noexcept;

 private:
  std::vector<PdoEntry> entries_;
  std::uint8_t bytes_ = 0;
};

/// Reads "6076:00". @throw InputError that says what came.
ObjectAddress readObjectAddress(const std::string& text);
/// Reads "60640020". @throw InputError that names what came.
PdoEntry readPdoEntry(const std::string& text);

}  // namespace ballbot
