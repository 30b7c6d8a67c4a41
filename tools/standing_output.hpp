#pragma once

#include <string>

#include "hil/identify/stand.hpp"

namespace ballbot {

/// Brings a drive's output into a posture: by its test stand where it has one, else by asking the
/// person at the terminal and waiting for Enter. Without a terminal nobody is asked to block the
/// joint, since whoever starts a script has done so.
/// @param drive_name  "wheel 1"
/// @throw InputError where a person is needed and there is no terminal; InterruptedError on Ctrl-C
void bringInto(Posture posture, SdoExchange& drive, const std::string& drive_name);

}  // namespace ballbot
