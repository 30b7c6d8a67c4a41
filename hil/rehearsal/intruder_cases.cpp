#include "hil/rehearsal/case_makers.hpp"

namespace ballbot {
namespace {

using B = BenchFault;

constexpr int kSdoRound = 400;  // all watched parameters of all drives, once
const Reasons kForeign = {B::kForeignFrame};

FaultCase foreign(const char* name, int bus, CanFrame frame) {
  return off(name, 1, kForeign, [=](Rehearsal& r) { r.wire(bus).intrude(frame); });
}

CanFrame simple(std::uint32_t id, std::uint8_t size, std::uint8_t a = 0, std::uint8_t b = 0) {
  return CanFrame{id, false, false, size, {a, b}};
}

/// On the way to the drive; while it is ready it is commanded to run with 2 N m.
FaultCase unheard(const char* name) {
  FaultCase c = off(name, 4, {B::kDriveUnbidden}, [](Rehearsal& r) {
    changeToDrives(r, 0, rpdoOf(1, 1), [](CanFrame& f) {
      if (f.data[0] == 0x07) {
        put(0, 2, 0x0F)(f);
        put(2, 2, 100)(f);
      }
    });
  });
  c.while_ready = true;
  return c;
}

}  // namespace

std::vector<FaultCase> intruderCases() {
  FaultCase enables = foreign("intruder: enables a drive with 2 N m while it is ready", 0,
                              foreignCommand(1, 0x0F, 100));
  enables.while_ready = true;
  FaultCase twin = off("intruder: a second node with the identity of a drive", 3,
                       {B::kNodeTwin, B::kPositionJump, B::kSpringDisagrees}, [](Rehearsal& r) {
                         r.wire(1).onWayToMaster([](const CanFrame& f, std::vector<CanFrame>& out) {
                           out.push_back(f);
                           if (f.id == tpdoOf(4, 1)) {
                             out.push_back(f);
                             put(4, 4, 100)(out.back());
                           }
                         });
                       });
  const auto parameter = [](const char* name, Reasons reasons, int cycles, std::uint16_t index,
                            int sub, std::int64_t value, int bytes) {
    return off(name, cycles, std::move(reasons),
               [=](Rehearsal& r) { tellDrive(r, 1, sdoWrite(1, index, sub, value, bytes)); });
  };
  const Reasons changed = {B::kParameterChanged};
  return {
      foreign("intruder: commands a drive's torque", 0, foreignCommand(2, 0x0F, 60)),
      enables,
      unheard("intruder: enables a ready drive, unheard by the master"),
      foreign("intruder: switches a drive's mode by SDO", 0, sdoWrite(1, 0x6060, 0, 8, 1)),
      foreign("intruder: raises a drive's max torque by SDO", 1, sdoWrite(4, 0x6072, 0, 1500, 2)),
      foreign("intruder: reads a drive's parameters", 0,
              CanFrame{0x602, false, false, 8, {0x40, 0x76, 0x60}}),
      foreign("intruder: NMT stop for one drive", 0, simple(0x000, 2, 0x02, 2)),
      foreign("intruder: NMT reset for all", 1, simple(0x000, 2, 0x81, 0)),
      foreign("intruder: heartbeat in the master's name", 0, simple(0x77F, 1, 0x05)),
      twin,
      parameter("parameter: mode changed, unheard", {B::kEchoDiffers, B::kTorqueDiffers}, 4, 0x6060,
                0, 8, 1),
      parameter("parameter: max torque lowered, unheard", {B::kEchoDiffers, B::kTorqueDiffers}, 30,
                0x6072, 0, 5, 2),
      parameter("parameter: max torque raised, unheard", changed, kSdoRound, 0x6072, 0, 1500, 2),
      parameter("parameter: reaction to a lost master changed, unheard", changed, kSdoRound, 0x6007,
                0, 0, 2),
      parameter("parameter: watch over the master switched off, unheard", changed, kSdoRound,
                0x1016, 1, 0, 4),
  };
}

}  // namespace ballbot
