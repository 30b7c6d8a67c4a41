#pragma once

#include <cstddef>

#include <linux/can.h>

#include "hil/can_frame.hpp"

namespace ballbot {

// Frames as the kernel's CAN sockets carry them: `can_frame`, or `canfd_frame` where the socket has
// been told to take CAN FD. Both begin alike, so one buffer holds either.

/// Writes the frame; returns how many bytes to send, 0 if it is not valid.
std::size_t toKernel(const CanFrame& frame, canfd_frame& raw) noexcept;

enum class KernelFrame {
  kFrame,      ///< `out` holds it
  kError,      ///< an error frame: raw.can_id says which
  kMalformed,  ///< neither
};
/// @param bytes  that were received
KernelFrame fromKernel(const canfd_frame& raw, std::size_t bytes, CanFrame& out) noexcept;

}  // namespace ballbot
