#include "hil/socketcan_frame.hpp"

#include <algorithm>

namespace ballbot {

std::size_t toKernel(const CanFrame& frame, canfd_frame& raw) noexcept {
  if (!isValid(frame)) return 0;
  raw = canfd_frame{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
  raw.len = frame.size;
  if (frame.fast) raw.flags = CANFD_BRS;
  if (!frame.remote) std::copy_n(frame.data.begin(), frame.size, raw.data);
  return frame.flexible ? CANFD_MTU : CAN_MTU;
}

KernelFrame fromKernel(const canfd_frame& raw, std::size_t bytes, CanFrame& out) noexcept {
  if (bytes != CAN_MTU && bytes != CANFD_MTU) return KernelFrame::kMalformed;
  const bool flexible = bytes == CANFD_MTU;
  if (raw.len > (flexible ? CANFD_MAX_DLEN : CAN_MAX_DLEN)) return KernelFrame::kMalformed;
  if ((raw.can_id & CAN_ERR_FLAG) != 0) return KernelFrame::kError;
  out = CanFrame{};
  out.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  out.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
  out.id = raw.can_id & (out.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  out.size = raw.len;
  out.flexible = flexible;
  out.fast = flexible && (raw.flags & CANFD_BRS) != 0;
  if (!out.remote) std::copy_n(raw.data, raw.len, out.data.begin());
  return isValid(out) ? KernelFrame::kFrame : KernelFrame::kMalformed;
}

}  // namespace ballbot
