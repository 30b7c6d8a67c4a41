#include "hil/rehearsal/case_makers.hpp"

namespace ballbot {
namespace {

using F = EmulatedFault;
using B = BenchFault;

FrameChange scaled(int begin, double factor) {
  return [=](CanFrame& f) {
    const auto at = static_cast<std::size_t>(begin);
    const auto value = static_cast<std::int16_t>(f.data[at] | f.data[at + 1] << 8);
    put(begin, 2, static_cast<std::int64_t>(factor * value))(f);
  };
}

Start lose(std::function<bool(int)> lost) {
  return [lost = std::move(lost)](Rehearsal& r) {
    r.wire(0).onWayToMaster(
        [lost, cycle = -1](const CanFrame& f, std::vector<CanFrame>& out) mutable {
          if (f.id == imuPdo(1)) ++cycle;
          if ((f.id != imuPdo(1) && f.id != imuPdo(2)) || !lost(cycle)) out.push_back(f);
        });
  };
}

}  // namespace

std::vector<FaultCase> imuCases() {
  const int stale = SafetyConfig{}.stale_cycles;
  const Reasons repeats = {B::kImuRepeats};
  const Reasons axis = {B::kImuDisagrees, B::kTiltLimit};
  const auto swapXZ = [](CanFrame& f) {
    std::swap(f.data[0], f.data[4]);
    std::swap(f.data[1], f.data[5]);
  };
  return {
      damped("IMU: lost", stale, {B::kImuStale}, inside(F::kImuLost)),
      damped("IMU: sends one sample for ever", stale, {B::kImuStale}, inside(F::kImuFrozen)),
      damped("IMU: one of its two frames is lost", stale, {B::kImuStale},
             [](Rehearsal& r) {
               r.wire(0).onWayToMaster([](const CanFrame& f, std::vector<CanFrame>& out) {
                 if (f.id != imuPdo(2)) out.push_back(f);
               });
             }),
      damped("IMU: a byte short", stale, {B::kImuStale}, onImu(1, [](CanFrame& f) { f.size = 7; })),
      damped("IMU: samples in one cycle of three", 9, {B::kImuStale},
             lose([](int cycle) { return cycle % 3 != 2; })),
      off("IMU: all values frozen, the counter runs", 7, repeats,
          both(onImu(1, freezeBytes(0, 6)), onImu(2, freezeBytes(0, 6)))),
      off("IMU: gyroscope frozen", 7, repeats, onImu(2, freezeBytes(0, 6))),
      off("IMU: accelerometer frozen", 7, repeats, onImu(1, freezeBytes(0, 6))),
      off("IMU: gyroscope says nothing turns", 7, repeats,
          onImu(2, [](CanFrame& f) { f.data = {}; })),
      off("IMU: accelerometer feels nothing", 8, {B::kImuRepeats, B::kImuDisagrees},
          onImu(1, scaled(4, 0.0))),
      off("IMU: accelerometer scaled by four", 8, {B::kImuDisagrees}, onImu(1, scaled(4, 4.0))),
      off("IMU: z axis upside down", 60, axis, onImu(1, negate(4, 2))),
      off("IMU: x and z exchanged", 80, axis, onImu(1, swapXZ)),
      damped("IMU: gyroscope turns by 5 rad/s more", 40, {B::kTiltLimit, B::kImuDisagrees},
             onImu(2, addTo(0, 2, 4695))),
      damped("robot: leans over", 20, {B::kTiltLimit}, inside(F::kTilt, 0, 0.8)),
  };
}

std::vector<FaultCase> busCases() {
  const int stale = SafetyConfig{}.stale_cycles;
  // Drives that hear nothing any more stop by their own RPDO deadline, 15 ms, and a ramp after it.
  constexpr int kDriveDeadline = 8;
  const auto twice = [](Rehearsal& r) {
    r.wire(0).onWayToMaster(
        [](const CanFrame& f, std::vector<CanFrame>& out) { out.insert(out.end(), 2, f); });
  };
  const auto deaf = [](Rehearsal& r) {
    r.wire(1).onWayToMaster([](const CanFrame&, std::vector<CanFrame>&) {});
  };
  return {
      off("bus: nothing passes any more", kDriveDeadline, {B::kDriveStale},
          inside(F::kFrozenBus, 4)),
      off("bus: nothing passes on the wheels' bus", kDriveDeadline, {B::kDriveStale},
          inside(F::kFrozenBus, 0)),
      off("bus: nothing comes back from the arm", stale, {B::kDriveStale}, deaf),
      off("bus: SYNC held back on its way", stale, {B::kDriveStale},
          inside(F::kSyncHeldBack, 4, 20)),
      off("bus: adapter pulled out", kDriveDeadline, {B::kBusDown},
          [](Rehearsal& r) { r.pullBus1(); }),
      off("bus: every frame comes twice", 3, {B::kNodeTwin}, twice),
  };
}

}  // namespace ballbot
