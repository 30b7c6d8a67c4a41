#pragma once

#include <cstdint>
#include <functional>

#include "hil/rehearsal/rehearsal.hpp"

namespace ballbot {

// What can be done to frames on their way. Drives are numbered from 0; their frames are those of
// the default mapping: TPDO1 statusword, torque, position; TPDO2 velocity, motor angle; TPDO3
// torque demand; RPDO1 controlword, torque. All numbers little endian.

using FrameChange = std::function<void(CanFrame&)>;

/// Bus and identifier of a drive's PDO (`number` from 1), and of the IMU's.
int busOfDrive(int drive);
std::uint32_t tpdoOf(int drive, int number);
std::uint32_t rpdoOf(int drive, int number);
std::uint32_t imuPdo(int number);

/// Changes every frame with this identifier on its way to the master, or to the drives.
void changeToMaster(Rehearsal& r, int bus, std::uint32_t id, FrameChange change);
void changeToDrives(Rehearsal& r, int bus, std::uint32_t id, FrameChange change);
/// From now on the frame is the one that came next, in the bytes from `begin` to before `end`.
FrameChange freezeBytes(int begin, int end);
/// Adds to a little endian number.
FrameChange addTo(int begin, int bytes, std::int64_t value);
FrameChange negate(int begin, int bytes);
FrameChange put(int begin, int bytes, std::int64_t value);

/// Drops frames of a drive's PDOs on their way to the master in the cycles that `lost` names,
/// counted from 0.
void losePdos(Rehearsal& r, int drive, std::function<bool(int)> lost);
/// Every PDO of a drive comes a cycle late.
void delayPdos(Rehearsal& r, int drive);
/// Frames with this identifier come as those of the other.
void swapToMaster(Rehearsal& r, int bus, std::uint32_t a, std::uint32_t b);

/// An SDO download of up to four bytes.
CanFrame sdoWrite(int drive, std::uint16_t index, int sub, std::int64_t value, int bytes);
/// RPDO1 as a foreign master would send it, torque in per mille.
CanFrame foreignCommand(int drive, std::uint16_t controlword, int torque);
/// The drives hear it and the master does not, as on a wire that is broken in one direction.
void tellDrive(Rehearsal& r, int drive, const CanFrame& frame);

}  // namespace ballbot
