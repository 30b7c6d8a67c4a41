#include <limits>

#include "hil/rehearsal/case_makers.hpp"

namespace ballbot {
namespace {

using B = BenchFault;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

FaultCase turned(const char* name, int cycles, Reasons reasons,
                 std::function<void(Rehearsal&, Turn&, int)> each) {
  FaultCase c = damped(name, cycles, std::move(reasons), {});
  c.each = std::move(each);
  return c;
}

}  // namespace

std::vector<FaultCase> commandCases() {
  const SafetyConfig s;
  const Reasons finite = {B::kCommandNotFinite};
  FaultCase hung = off("master: hangs, SYNC goes on", 12, {}, {});
  hung.without_master = true;
  FaultCase hangs = off("controller: one command again and again", s.command_repeats + 1,
                        {B::kCommandRepeats}, {});
  hangs.each = [](Rehearsal&, Turn& t, int) { t.command.torque.fill(0.3); };
  FaultCase late = damped("loop: oversleeps five periods", 7, {B::kLateLoop},
                          [](Rehearsal& r) { r.oversleep(5); });
  late.stepped = false;  // there the drives' clock waits for the loop
  return {
      turned("controller: silent", s.watchdog_cycles + 1, {B::kCommandTimeout},
             [](Rehearsal&, Turn& t, int) { t.silent = true; }),
      turned("controller: commands in one cycle of thirty", s.watchdog_cycles + 1,
             {B::kCommandTimeout}, [](Rehearsal&, Turn& t, int n) { t.silent = n % 30 != 0; }),
      hangs,
      turned("controller: command is NaN", 1, finite,
             [](Rehearsal&, Turn& t, int) { t.command.torque[3] = kNan; }),
      turned("controller: command is infinite", 1, finite,
             [](Rehearsal&, Turn& t, int) { t.command.torque[0] = kInfinity; }),
      turned("controller: damping is NaN", 1, finite,
             [](Rehearsal&, Turn& t, int) { t.command.damping[5] = kNan; }),
      turned("controller: asks for 1e6 N m in turns", 10, {B::kCommandAbsurd},
             [](Rehearsal&, Turn& t, int n) { t.command.torque[1] = n % 2 == 0 ? 1e6 : -1e6; }),
      late,
      damped("person: Ctrl-C", 2, {}, [](Rehearsal& r) { r.interrupt(); }),
      hung,
  };
}

std::vector<FaultCase> wayDownCases() {
  const SafetyConfig s;
  // Whoever the drive obeys, it is told "run, 1 N m" where the master says `words`.
  const auto disobey = [](int drive, std::vector<std::uint8_t> words) {
    return [=](Rehearsal& r) {
      changeToDrives(r, busOfDrive(drive), rpdoOf(drive, 1), [words](CanFrame& f) {
        for (const std::uint8_t word : words) {
          if (f.data[0] != word) continue;
          put(0, 2, 0x0F)(f);
          put(2, 2, 50)(f);
          return;
        }
      });
    };
  };
  const auto deafToNmt = [](int drive) {
    return [=](Rehearsal& r) {
      r.wire(busOfDrive(drive)).onWayToDrives([=](const CanFrame& f, std::vector<CanFrame>& out) {
        if (f.id != 0x000 || f.data[1] != drive + 1) out.push_back(f);
      });
    };
  };
  const auto deafToSdo = [](int drive) {
    return [=](Rehearsal& r) {
      r.wire(busOfDrive(drive)).onWayToDrives([=](const CanFrame& f, std::vector<CanFrame>& out) {
        const bool controlword = f.data[1] == 0x40 && f.data[2] == 0x60;
        if (f.id != 0x601U + static_cast<unsigned>(drive) || !controlword) out.push_back(f);
      });
    };
  };
  const auto stop = [](Rehearsal& r) { r.interrupt(); };
  FaultCase quick = damped("way down: ignores disable voltage, a person stops", 1,
                           {B::kDriveTransition}, both(disobey(2, {0x00}), stop));
  quick.way_down_cycles = s.confirm_cycles + 3;
  FaultCase nmt = damped("way down: ignores quick stop too, a person stops", 1,
                         {B::kDriveTransition}, both(disobey(4, {0x00, 0x02}), stop));
  nmt.way_down_cycles = 3 * s.confirm_cycles + 4;
  FaultCase sdo =
      damped("way down: obeys its SDO server alone, a person stops", 1, {B::kDriveTransition},
             both(both(disobey(4, {0x00, 0x02}), deafToNmt(4)), stop));
  sdo.way_down_cycles = 3 * s.confirm_cycles + 6;
  FaultCase fault =
      off("way down: ignores disable voltage after another drive's fault", 1, {B::kNodeTrouble},
          both(disobey(1, {0x00}), inside(EmulatedFault::kEmergency, 4, 0x2310)));
  fault.way_down_cycles = s.confirm_cycles + 3;
  FaultCase never =
      damped("way down: obeys nothing, a person stops", 1, {B::kDriveTransition},
             both(both(disobey(3, {0x00, 0x02}), both(deafToNmt(3), deafToSdo(3))), stop));
  never.reaction = Reaction::kSaid;
  FaultCase never_off = never;
  never_off.name = "way down: obeys nothing, the IMU freezes";
  never_off.reasons = {B::kImuRepeats};
  never_off.detection_cycles = 7;
  never_off.start = both(both(disobey(0, {0x00, 0x02}), both(deafToNmt(0), deafToSdo(0))),
                         both(onImu(1, freezeBytes(0, 6)), onImu(2, freezeBytes(0, 6))));
  FaultCase liar = damped("way down: statusword frozen at enabled, a person stops", 1,
                          {B::kDriveTransition}, both(onTpdo(5, 1, freezeBytes(0, 2)), stop));
  liar.way_down_cycles = 2;
  return {quick, nmt, sdo, fault, never, never_off, liar};
}

}  // namespace ballbot
