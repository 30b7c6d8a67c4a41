#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hil/can_frame.hpp"

namespace ballbot {

// The ASCII protocol of serial CAN adapters (LAWICEL CAN232/CANUSB, "slcan"), as its host speaks
// it:
//
//   tiiildd..  Tiiiiiiiildd..   data frame, 11 or 29 bit identifier, l bytes, hexadecimal
//   riiil      Riiiiiiiil       remote frame
//   diiil.. Diiiiiiiil..        CAN FD, as CANable adapters have it: l is the length code, 0 to F;
//   biiil.. Biiiiiiiil..        b and B with the data at the rate of Yn
//   CR (CR LF)                  ends a line; alone: done.  z CR, Z CR: frame queued
//   BELL                        the adapter refuses the last command

/// Longest line either side sends: B, 8 digits, length, 128 digits, 8 of a time stamp, CR.
constexpr std::size_t kSlcanLineMax = 147;

/// Writes `frame` as one line with its CR; returns the number of characters, 0 if it is not valid.
std::size_t encodeSlcan(const CanFrame& frame, std::array<char, kSlcanLineMax>& out) noexcept;

/// Turns an adapter's bytes, in pieces of any size, into frames and replies. Anything that is not
/// exactly one of them is counted and skipped up to the next CR or BELL.
class SlcanParser {
 public:
  enum class Item {
    kNone,       ///< the line is not complete
    kFrame,      ///< frame() holds it
    kDone,       ///< a command was accepted
    kRefused,    ///< BELL
    kStatus,     ///< answer to F; status() holds the flags
    kText,       ///< answer to V, v or N; of no further use here
    kMalformed,  ///< a line that is none of these
  };

  Item take(char c) noexcept;
  const CanFrame& frame() const noexcept { return frame_; }
  /// Flags of the adapter's F reply: bit 0 receive queue full, 1 transmit queue full, 2 error
  /// warning, 3 data overrun, 5 error passive, 6 arbitration lost, 7 bus error.
  std::uint8_t status() const noexcept { return status_; }

 private:
  Item finishLine() noexcept;
  bool parseFrame() noexcept;
  Item parseStatus() noexcept;

  std::array<char, kSlcanLineMax> line_{};
  std::size_t length_ = 0;
  bool too_long_ = false;
  CanFrame frame_;
  std::uint8_t status_ = 0;
};

}  // namespace ballbot
