#pragma once

#include "hil/identify/record.hpp"
#include "hil/sdo_exchange.hpp"

namespace ballbot {

/// Whether a drive stands on a test stand that blocks, frees and turns its output by itself: the
/// emulated drives' object 2020:01 is not zero there. Otherwise a person does it.
bool hasStand(SdoExchange& drive);

/// @throw LostParticipantError if the stand does not obey.
void setStand(SdoExchange& drive, Posture posture);

/// Whether a drive has its motor's current, object 6078, at all.
bool hasCurrent(SdoExchange& drive);

}  // namespace ballbot
