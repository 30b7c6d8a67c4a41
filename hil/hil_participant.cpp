#include "hil/hil_participant.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/digest.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

BenchCommand toBench(const ActuatorCommand& c) {
  BenchCommand out;
  for (int i = 0; i < kDriveCount; ++i) {
    const auto n = static_cast<std::size_t>(i);
    out.torque[n] = c.torque[i];
    out.position[n] = c.position[i];
    out.velocity[n] = c.velocity[i];
    out.stiffness[n] = c.stiffness[i];
    out.damping[n] = c.damping[i];
  }
  return out;
}

[[noreturn]] void refuseState() {
  throw Error(ExitCode::kBadInput,
              "hil: the state of real drives can be neither saved nor restored");
}

}  // namespace

HilParticipant::HilParticipant(BenchRunner& runner)
    : runner_(runner), period_(runner.bench().config().cycle) {}

void HilParticipant::enterInitializationMode(SimTime start) {
  runner_.engage();
  start_ = start;
  cycle_ = 0;
  digest_ = 0;
  const BenchSample& sample = runner_.sample(0);
  first_imu_count_ = sample.imu_count;
  adopt(sample, 0);
}

void HilParticipant::terminate() {
  runner_.release();
  runner_.requireGoodEnd();
}

void HilParticipant::requireShort(SimDuration step) const {
  if (step % period_ != SimDuration::zero()) {
    runner_.release();
    throw InputError(fmt::format(
        "hil: a step of {:.6g} ms, and the bus has a cycle of {:.6g} ms: periods of the scenario's "
        "`rates` must be whole multiples of the bench file's cycle_us",
        1e3 * toSeconds(step), 1e3 * toSeconds(period_)));
  }
  const SimDuration longest = runner_.bench().config().safety.watchdog_cycles * period_;
  if (step <= longest) return;
  runner_.release();
  throw InputError(
      fmt::format("hil: a step of {:.6g} ms, at most {:.6g} ms are made with one command "
                  "(safety.command_watchdog_ms). The drives have been told to stop. "
                  "docs/troubleshooting/bench-command.md",
                  1e3 * toSeconds(step), 1e3 * toSeconds(longest)));
}

void HilParticipant::doStep(SimTime now, SimDuration step, const ActuatorCommand& command) {
  requireShort(step);
  runner_.command((now - start_) / period_, toBench(command));
  const std::int64_t reached = (now + step - start_) / period_;
  while (cycle_ < reached) {
    const BenchSample& sample = runner_.sample(++cycle_);
    adopt(sample, cycle_);
  }
}

void HilParticipant::adopt(const BenchSample& s, std::int64_t cycle) {
  SensorFrame& f = sensors_;
  f.time = start_ + cycle * period_;
  for (int i = 0; i < kDriveCount; ++i) {
    const auto n = static_cast<std::size_t>(i);
    f.motor_angle[i] = s.motor_angle[n];
    f.joint_angle[i] = s.joint_angle[n];
    f.joint_velocity[i] = s.joint_velocity[n];
    f.joint_torque[i] = s.joint_torque[n];
  }
  f.imu_count = s.imu_count - first_imu_count_ + 1;
  // By its age: a loop that skips periods counts fewer cycles than time has passed.
  f.imu_time = std::max(start_, f.time - (s.cycle - s.imu_cycle) * period_);
  for (int i = 0; i < 3; ++i) {
    f.accel_B[i] = s.accel[static_cast<std::size_t>(i)];
    f.gyro_WB_B[i] = s.gyro[static_cast<std::size_t>(i)];
  }
  Digest digest;
  digest.add(static_cast<std::int64_t>(digest_));
  digest.add(cycle);
  for (const DriveArray* a : {&s.joint_angle, &s.motor_angle, &s.joint_velocity, &s.joint_torque}) {
    digest.add(a->data(), sizeof *a);
  }
  digest.add(s.accel.data(), sizeof s.accel);
  digest.add(s.gyro.data(), sizeof s.gyro);
  digest_ = digest.low64();
}

StateBlob HilParticipant::saveState() const { refuseState(); }
void HilParticipant::restoreState(const StateBlob&) { refuseState(); }

}  // namespace ballbot
