#pragma once

#include <string>

#include "hil/bench_config.hpp"
#include "hil/can_frame.hpp"

namespace ballbot {

/// One frame of an SDO transfer in words, by itself (CiA 301, 7.2.4): "read 6072:00 max torque in
/// per mille", "6072:00 max torque in per mille 1500", "refused 6072:00: 06090030 (value out of
/// range)".
/// @param to_server  a request; else an answer
std::string sdoText(const CanFrame& frame, bool to_server, const DriveConfig* drive);

}  // namespace ballbot
