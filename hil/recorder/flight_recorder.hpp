#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hil/bench.hpp"
#include "hil/loop_clock.hpp"
#include "hil/recorder/overwriting_ring.hpp"

namespace ballbot {

/// One frame as it passed the bench's end of a bus.
struct RecordedFrame {
  std::int64_t time_ns = 0;  ///< bus time: FlightRecorder::timeNs()
  std::int64_t cycle = 0;    ///< 0: before the first SYNC
  CanFrame frame;
  std::uint8_t bus = 0;
  bool sent = false;     ///< by this master; else it came
  bool refused = false;  ///< could not be sent
};

/// A check that fired at a drive, over all cycles in which it did.
struct RecordedCheck {
  Finding finding;  ///< as it was when it fired first
  std::int64_t time_ns = 0, cycle = 0, last_cycle = 0;
  std::int64_t cycles = 0;  ///< in which it fired; 0: never
};

/// What a bench has to show for its last seconds: every frame in both directions, every cycle,
/// every check that fired. The cycle fills it; it neither allocates, locks nor throws. Whoever
/// reads it waits until the cycles have ended.
class FlightRecorder {
 public:
  static constexpr double kDefaultSeconds = 20;

  /// @param clock    of a real-time loop, must outlive this; null: the cycle number is the clock,
  ///                 so that equal runs give equal records
  /// @param seconds  that are kept, with the frames of a bus in order; more frames than that (an
  ///                 intruder, a babbling node) make it fewer
  FlightRecorder(const BenchConfig& config, LoopClock* clock, double seconds = kDefaultSeconds);

  /// Before the first frame of a cycle. @param cycle  of the master, from 1
  void beginCycle(std::int64_t cycle) noexcept;
  /// @return its time
  std::int64_t onFrame(int bus, const CanFrame& frame, bool sent, bool refused) noexcept;
  /// After the decision of a cycle and its last frame.
  void endCycle(const Bench& bench, CycleRecord record) noexcept;

  /// Bus time [ns]: that of the loop's clock, or cycles times period.
  std::int64_t timeNs() const noexcept;
  bool hasClock() const noexcept { return clock_ != nullptr; }

  const OverwritingRing<RecordedFrame>& frames() const noexcept { return frames_; }
  const OverwritingRing<CycleRecord>& cycles() const noexcept { return cycles_; }
  /// The check that ended the run; `cycles` is 0 if none did. Of several in its cycle the gravest.
  const RecordedCheck& first() const noexcept { return first_; }
  /// All that fired, in the order in which they did.
  std::vector<RecordedCheck> checks() const;

 private:
  static constexpr std::size_t kPlaces = kDriveCount + 2;  ///< none, six drives, the IMU
  void note(const Finding& finding, const CycleRecord& record) noexcept;

  LoopClock* clock_;
  std::int64_t period_ns_;
  std::int64_t cycle_ = 0, began_ns_ = 0;
  OverwritingRing<RecordedFrame> frames_;
  OverwritingRing<CycleRecord> cycles_;
  RecordedCheck first_;
  std::array<RecordedCheck, kCheckCount * kPlaces> checks_{};
};

}  // namespace ballbot
