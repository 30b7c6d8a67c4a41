#include "hil/rehearsal/case_makers.hpp"

namespace ballbot {
namespace {

using F = EmulatedFault;
using B = BenchFault;

// Counts of 6064 and 60E4 for an angle of a turn of 14400 and 720000.
constexpr std::int64_t jointCounts(double rad) {
  return static_cast<std::int64_t>(rad * 14400 / 6.283185307179586);
}
constexpr std::int64_t motorCounts(double rad) {
  return static_cast<std::int64_t>(rad * 720000 / 6.283185307179586);
}

/// Both encoders of a drive read so much more.
Start shift(int drive, double rad) {
  return both(onTpdo(drive, 1, addTo(4, 4, jointCounts(rad))),
              onTpdo(drive, 2, addTo(4, 4, motorCounts(rad))));
}

/// Grows in every frame.
FrameChange creep(int begin, std::int64_t counts_per_cycle) {
  return [=, sum = std::int64_t{0}](CanFrame& f) mutable {
    sum += counts_per_cycle;
    addTo(begin, 4, sum)(f);
  };
}

FrameChange garbage(int begin, int end) {
  return [=, state = std::uint32_t{12345}](CanFrame& f) mutable {
    for (int i = begin; i < end; ++i) {
      state = state * 1664525U + 1013904223U;
      f.data[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(state >> 24);
    }
  };
}

/// The rig turns steadily until it stands just behind the limit.
void approachLimit(Rehearsal& r) {
  BenchCommand c;
  for (int n = 0; n < 2000 && !r.ended(); ++n) {
    c.torque.fill(0.3 + 1e-3 * (n % 2));
    r.cycle(&c);
    if (r.bench().master().sample().joint_angle[3] > kTrialAngleLimit - 0.01) break;
  }
  r.torque().begin();
}

}  // namespace

std::vector<FaultCase> encoderCases() {
  const Reasons jump = {B::kPositionJump, B::kSpringDisagrees};
  const Reasons moves = {B::kPositionJump, B::kSpringDisagrees, B::kEncoderImplausible};
  const Reasons torque = {B::kTorqueDiffers, B::kTorqueRepeats, B::kSpringDisagrees};
  FaultCase limit = damped("drive: angle beyond its limit", 6, {B::kPositionLimit}, approachLimit);
  return {
      off("encoder: joint angle frozen while it turns", 8, moves, inside(F::kStuckEncoder)),
      off("encoder: both angles jump by 0.5 rad", 1, jump, inside(F::kPositionJump, 4, 0.5)),
      off("encoder: joint angle jumps by 0.04 rad", 1, jump,
          onTpdo(1, 1, addTo(4, 4, jointCounts(0.04)))),
      off("encoder: both angles jump by 0.04 rad", 1, jump, shift(2, 0.04)),
      off("encoder: both angles get an offset of 20 degrees", 1, jump, shift(4, 0.349)),
      off("encoder: jump of 0.5 rad together with a lost PDO", 2, jump,
          both(shift(1, 0.5),
               [](Rehearsal& r) { losePdos(r, 1, [](int cycle) { return cycle == 0; }); })),
      off("encoder: joint angle creeps by 1 rad/s", 8, moves,
          onTpdo(0, 1, creep(4, jointCounts(0.0025)))),
      off("encoder: both angles creep by 1 rad/s", 40, moves,
          both(onTpdo(0, 1, creep(4, jointCounts(0.0025))),
               onTpdo(0, 2, creep(4, motorCounts(0.0025))))),
      off("encoder: joint angle is garbage", 1, jump, onTpdo(5, 1, garbage(4, 8))),
      off("encoder: motor angle frozen", 12, {B::kSpringDisagrees},
          onTpdo(1, 2, freezeBytes(4, 8))),
      off("encoder: motor angle is garbage", 3, {B::kSpringDisagrees}, onTpdo(3, 2, garbage(4, 8))),
      off("encoder: motor angle off by 1 degree", 3, {B::kSpringDisagrees},
          onTpdo(2, 2, addTo(4, 4, motorCounts(0.01745)))),
      off("encoder: velocity is zero", 40, moves, onTpdo(1, 2, put(0, 4, 0))),
      off("encoder: velocity has the wrong sign", 20, moves, onTpdo(5, 2, negate(0, 4))),
      off("torque: actual torque frozen", 20, torque, onTpdo(1, 1, freezeBytes(2, 4))),
      off("torque: actual torque is zero", 20, torque, onTpdo(4, 1, put(2, 2, 0))),
      off("torque: actual torque has the wrong sign", 20, torque, onTpdo(0, 1, negate(2, 2))),
      off("torque: actual torque 1 N m too high", 12, torque, onTpdo(3, 1, addTo(2, 2, 50))),
      damped("drive: velocity beyond its limit", 1, {B::kVelocityLimit},
             inside(F::kRunaway, 0, 12.5)),
      limit,
  };
}

std::vector<FaultCase> pdoCases() {
  const Reasons told = {B::kEchoDiffers, B::kTorqueDiffers};
  const auto lose = [](int drive, std::function<bool(int)> lost) {
    return [=](Rehearsal& r) { losePdos(r, drive, lost); };
  };
  const Start all_frozen =
      both(onTpdo(1, 1, freezeBytes(0, 8)),
           both(onTpdo(1, 2, freezeBytes(0, 8)), onTpdo(1, 3, freezeBytes(0, 8))));
  return {
      off("PDOs: all data of a drive frozen", 10,
          {B::kEchoDiffers, B::kEncoderImplausible, B::kTorqueRepeats, B::kPositionJump},
          all_frozen),
      off("PDOs: TPDO1 of a drive frozen", 12,
          {B::kSpringDisagrees, B::kTorqueRepeats, B::kTorqueDiffers, B::kPositionJump,
           B::kEncoderImplausible},
          onTpdo(4, 1, freezeBytes(0, 8))),
      off("PDOs: TPDO2 of a drive frozen", 12,
          {B::kSpringDisagrees, B::kEncoderImplausible, B::kPositionJump},
          onTpdo(4, 2, freezeBytes(0, 8))),
      off("PDOs: torque demand frozen", 10, told, onTpdo(2, 3, freezeBytes(0, 2))),
      off("PDOs: always one cycle late", 10, {B::kEchoDiffers},
          [](Rehearsal& r) { delayPdos(r, 1); }),
      off("PDOs: in one cycle of three", 9, {B::kDriveMisses},
          lose(1, [](int cycle) { return cycle % 3 != 2; })),
      off("PDOs: in one cycle of two", 12, {B::kDriveMisses},
          lose(4, [](int cycle) { return cycle % 2 == 0; })),
      off("PDOs: every fourth is missing", 24, {B::kDriveMisses},
          lose(3, [](int cycle) { return cycle % 4 == 0; })),
      off("PDOs: TPDO2 alone is lost", 3, {B::kDriveStale},
          [](Rehearsal& r) {
            r.wire(0).onWayToMaster([](const CanFrame& f, std::vector<CanFrame>& out) {
              if (f.id != tpdoOf(1, 2)) out.push_back(f);
            });
          }),
      off("PDOs: two drives answer for each other", 10,
          {B::kEchoDiffers, B::kPositionJump, B::kSpringDisagrees, B::kTorqueDiffers},
          [](Rehearsal& r) {
            for (int n = 1; n <= 3; ++n) swapToMaster(r, 0, tpdoOf(0, n), tpdoOf(1, n));
          }),
      off("RPDOs: torque has the wrong sign", 8, told,
          [](Rehearsal& r) { changeToDrives(r, 0, rpdoOf(1, 1), negate(2, 2)); }),
      off("RPDOs: torque frozen", 10, told,
          [](Rehearsal& r) { changeToDrives(r, 1, rpdoOf(3, 1), freezeBytes(2, 4)); }),
      off("RPDOs: torque 1 N m too high", 3, told,
          [](Rehearsal& r) { changeToDrives(r, 0, rpdoOf(2, 1), addTo(2, 2, 50)); }),
      off("RPDOs: torque ten times as high", 4, told,
          [](Rehearsal& r) {
            changeToDrives(r, 0, rpdoOf(0, 1), [](CanFrame& f) {
              const auto torque = static_cast<std::int16_t>(f.data[2] | f.data[3] << 8);
              put(2, 2, 10 * torque)(f);
            });
          }),
      off("RPDOs: of one drive lost", 8, {B::kEchoDiffers, B::kTorqueDiffers, B::kNodeTrouble},
          [](Rehearsal& r) {
            r.wire(0).onWayToDrives([](const CanFrame& f, std::vector<CanFrame>& out) {
              if (f.id != rpdoOf(1, 1)) out.push_back(f);
            });
          }),
      off("RPDOs: a byte short", 8, {B::kNodeTrouble, B::kEchoDiffers},
          [](Rehearsal& r) {
            changeToDrives(r, 1, rpdoOf(5, 1), [](CanFrame& f) { f.size = 3; });
          }),
  };
}

}  // namespace ballbot
