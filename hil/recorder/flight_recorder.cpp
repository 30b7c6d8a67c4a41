#include "hil/recorder/flight_recorder.hpp"

#include <algorithm>
#include <cmath>

namespace ballbot {
namespace {

// Beyond the PDOs of a cycle: SYNC, heartbeats and questions by SDO, with room for disorder.
constexpr double kOtherFrames = 8, kMargin = 1.25;
constexpr std::size_t kImuPdos = 2;

std::size_t cyclesIn(const BenchConfig& config, double seconds) {
  return static_cast<std::size_t>(std::ceil(seconds / config.cycleSeconds()));
}

std::size_t framesIn(const BenchConfig& config, double seconds) {
  const auto pdos =
      static_cast<double>(kDriveCount * (config.inputs.size() + config.outputs.size()) + kImuPdos);
  return static_cast<std::size_t>(kMargin * (pdos + kOtherFrames) *
                                  static_cast<double>(cyclesIn(config, seconds)));
}

}  // namespace

FlightRecorder::FlightRecorder(const BenchConfig& config, LoopClock* clock, double seconds)
    : clock_(clock),
      period_ns_(config.cycle.count()),
      frames_(framesIn(config, seconds)),
      cycles_(cyclesIn(config, seconds)) {}

std::int64_t FlightRecorder::timeNs() const noexcept {
  return clock_ != nullptr ? clock_->now() : cycle_ * period_ns_;
}

void FlightRecorder::beginCycle(std::int64_t cycle) noexcept {
  cycle_ = cycle;
  began_ns_ = timeNs();
}

std::int64_t FlightRecorder::onFrame(int bus, const CanFrame& frame, bool sent,
                                     bool refused) noexcept {
  const std::int64_t now = timeNs();
  frames_.push({now, cycle_, frame, static_cast<std::uint8_t>(bus), sent, refused});
  return now;
}

void FlightRecorder::note(const Finding& finding, const CycleRecord& record) noexcept {
  const auto place = static_cast<std::size_t>(std::clamp(finding.drive, -1, kDriveCount) + 1);
  RecordedCheck& check = checks_[static_cast<std::size_t>(finding.fault) * kPlaces + place];
  if (check.cycles == 0) check = {finding, record.time_ns, record.cycle, record.cycle, 0};
  if (check.cycles == 0 || check.last_cycle != record.cycle) ++check.cycles;
  check.last_cycle = record.cycle;
}

void FlightRecorder::endCycle(const Bench& bench, CycleRecord record) noexcept {
  record.time_ns = began_ns_;
  cycles_.push(record);
  for (const Finding& finding : bench.findings()) note(finding, record);
  if (first_.cycles > 0 || record.fault == BenchFault::kNone) return;
  // What is decided by waiting, a drive that does not follow, is no finding of a cycle.
  note(bench.latched(), record);
  first_ = {bench.latched(), record.time_ns, record.cycle, record.cycle, 1};
}

std::vector<RecordedCheck> FlightRecorder::checks() const {
  std::vector<RecordedCheck> fired;
  for (const RecordedCheck& check : checks_) {
    if (check.cycles > 0) fired.push_back(check);
  }
  // The first one first, also among those of its own cycle.
  const auto isFirst = [this](const RecordedCheck& c) {
    return first_.cycles > 0 && c.finding.fault == first_.finding.fault &&
           c.finding.drive == first_.finding.drive && c.cycle == first_.cycle;
  };
  std::stable_sort(fired.begin(), fired.end(), [&](const auto& a, const auto& b) {
    return a.cycle != b.cycle ? a.cycle < b.cycle : isFirst(a) && !isFirst(b);
  });
  return fired;
}

}  // namespace ballbot
