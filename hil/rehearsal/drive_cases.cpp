#include "hil/rehearsal/case_makers.hpp"

namespace ballbot {
namespace {

using F = EmulatedFault;
using B = BenchFault;

// Without its frames a drive hears of no way down: it stops by its own RPDO deadline, 15 ms.
constexpr int kHeartbeatPhase = 4;

FaultCase emergency(int drive, std::uint16_t code, const char* what) {
  const std::string name = std::string("drive: ") + what;
  return off(name.c_str(), 1, {B::kNodeTrouble}, inside(F::kEmergency, drive, code));
}

/// Nothing is heard of the node any more, and only what it says itself tells when it has stopped.
FaultCase statuswordOf(const char* name, int word, Reasons reasons) {
  return off(name, 1, std::move(reasons), inside(F::kStatusword, 1, word));
}

}  // namespace

std::vector<FaultCase> driveCases() {
  const SafetyConfig s;
  const int stale = s.stale_cycles, beat = s.heartbeat_cycles + kHeartbeatPhase;
  const Reasons gone = {B::kDriveStale, B::kNodeTrouble};
  return {
      emergency(1, 0x2310, "over-current, emergency 2310"),
      emergency(4, 0x3210, "supply over-voltage, emergency 3210"),
      emergency(0, 0x3220, "supply under-voltage, emergency 3220"),
      emergency(5, 0x4310, "too hot, emergency 4310"),
      emergency(2, 0x7305, "encoder fault, emergency 7305"),
      emergency(3, 0x6320, "parameter fault, emergency 6320"),
      off("drive: fault whose emergency message is lost", 1, {B::kDriveFault},
          inside(F::kUnannouncedFault, 2, 0x7305)),
      off("drive: heartbeat lost, PDOs go on", beat, {B::kNodeTrouble}, inside(F::kHeartbeatLost)),
      off("drive: PDOs lost, heartbeat goes on", stale, {B::kDriveStale}, inside(F::kPdosLost)),
      off("drive: PDOs a byte short", stale, {B::kDriveStale}, inside(F::kPdosTruncated, 3)),
      off("drive: power loss", stale, {B::kDriveStale}, inside(F::kPowerLoss, 4)),
      off("drive: starts anew by itself", 1, {B::kNodeTrouble}, inside(F::kReboot, 2)),
      off("drive: leaves operational for stopped", stale, gone, inside(F::kNmtStop)),
      off("drive: leaves operational for pre-operational", stale, gone,
          inside(F::kNmtPreOperational)),
      off("drive: disabled locally", 1, {B::kDriveDroppedOut, B::kEchoDiffers},
          inside(F::kLocalDisable)),
  };
}

std::vector<FaultCase> statusCases() {
  const Reasons out = {B::kDriveDroppedOut};
  FaultCase frozen = off("drive: disabled locally, statusword frozen at enabled", 4,
                         {B::kEchoDiffers, B::kTorqueDiffers},
                         both(onTpdo(1, 1, put(0, 2, 0x1237)), inside(F::kLocalDisable)));
  return {
      statuswordOf("drive: statusword of no state", 0x1264, out),
      statuswordOf("drive: statusword says switched on", 0x0233, out),
      statuswordOf("drive: statusword says quick stop", 0x0217, out),
      statuswordOf("drive: statusword says fault", 0x0218, {B::kDriveFault}),
      statuswordOf("drive: statusword says fault reaction", 0x021F, {B::kDriveFault}),
      off("drive: heartbeat says pre-operational, PDOs go on", 5, {B::kNodeTrouble},
          [](Rehearsal& r) { changeToMaster(r, 0, 0x702, put(0, 1, 0x7F)); }),
      off("drive: heartbeat says boot-up, PDOs go on", 5, {B::kNodeTrouble},
          [](Rehearsal& r) { changeToMaster(r, 1, 0x705, put(0, 1, 0)); }),
      frozen,
  };
}

}  // namespace ballbot
