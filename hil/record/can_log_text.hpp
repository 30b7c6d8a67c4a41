#pragma once

#include <cstdint>
#include <string>

#include "hil/recorder/flight_recorder.hpp"

namespace ballbot {

// Frames as the programs of other people read them: can-utils (`canplayer -I`, `log2asc -I`) and
// python-can; Vector's tools and whatever imports their text.

/// A line of `candump -L`, with the direction as `candump -L -x` has it:
/// "(0000000001.057500) can0 181#37160A0000000000 R".
/// @param epoch_offset_ns  from bus time to the time since 1970
std::string candumpLine(const RecordedFrame& frame, std::int64_t epoch_offset_ns);

/// The lines before and after the frames of a Vector ASC file.
/// @param epoch_ns  since 1970, of the time that the file calls zero
std::string ascHeader(std::int64_t epoch_ns);
std::string ascFooter();
/// A line of one: "   1.057500 1  181             Rx   d 8 37 16 0A 00 00 00 00 00". Channels count
/// from 1. @param zero_ns  bus time that the file calls zero
std::string ascLine(const RecordedFrame& frame, std::int64_t zero_ns);

}  // namespace ballbot
