#include "cosim/log_compare.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "cosim/event_log.hpp"
#include "cosim/recorder.hpp"
#include "tests/cosim/support/temporary_folder.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;
using testing_support::TemporaryFolder;
using testing_support::wordsOf;

constexpr std::int64_t kTicks = 100;

/// Writes the log of a made-up run of 100 ticks, 0.4 ms apart; `change` may alter any tick.
template <typename Change>
void writeRun(const std::string& path, Change&& change, std::int64_t ticks = kTicks) {
  RecorderOptions options;
  options.log_path = path;
  Recorder recorder(options);
  for (std::int64_t number = 0; number < ticks; ++number) {
    SensorFrame sensors;
    sensors.joint_angle[0] = 0.01 * static_cast<double>(number);
    std::optional<TruthFrame> truth = TruthFrame{};
    ControlOutput control;
    control.command.torque[1] = 0.5;
    control.has_estimate = true;
    SimTime time = kSimStart + number * SimDuration{400'000};
    std::uint64_t state_digest = 7 + static_cast<std::uint64_t>(number);
    change(number, time, sensors, truth, control, state_digest);
    recorder.record({number, time, sensors, truth, control, state_digest});
  }
  recorder.close();
}

class LogCompare : public testing::Test {
 protected:
  LogCompare() {
    writeRun(a, [](auto&&...) {});
  }
  RunDifference difference() {
    const std::optional<RunDifference> found = compareLogs(a, b);
    EXPECT_TRUE(found.has_value());
    return found.value_or(RunDifference{});
  }
  TemporaryFolder folder;
  std::string a = folder.file("a"), b = folder.file("b");
};

TEST_F(LogCompare, EqualRunsAreIdentical) {
  writeRun(b, [](auto&&...) {});
  EXPECT_EQ(compareLogs(a, b), std::nullopt);
}

TEST_F(LogCompare, NamesTickAndChannelOfTheSmallestDifferenceEvenWhereNothingWasLogged) {
  // Tick 37 is at 14.8 ms, no multiple of any recording period.
  writeRun(b, [](std::int64_t n, SimTime&, SensorFrame&, auto& truth, ControlOutput&, auto&) {
    if (n == 37) truth->motor_angle[5] = std::nextafter(0.0, 1.0);
  });
  const RunDifference found = difference();
  EXPECT_EQ(found.tick, 37);
  EXPECT_EQ(found.time, kSimStart + SimDuration{14'800'000});
  EXPECT_EQ(found.channel, Channel::kTruth);
  EXPECT_EQ(found.text, "tick 37 at 0.014800 s: TRUTH_FRAME differs");
}

TEST_F(LogCompare, OfSeveralDifferencesTheFirstInTimeThenInOrderOfATickCounts) {
  writeRun(b, [](std::int64_t n, SimTime&, SensorFrame& sensors, auto&, ControlOutput& control,
                 std::uint64_t& state) {
    if (n >= 50) sensors.gyro_WB_B[0] = 1;
    if (n >= 49) control.command.damping[0] = 1;
    if (n >= 49) state = 0;
  });
  const RunDifference found = difference();
  EXPECT_EQ(found.tick, 49);
  EXPECT_EQ(found.channel, Channel::kCommand);
}

TEST_F(LogCompare, AHiddenDifferenceOfTheStateIsFound) {
  writeRun(b, [](std::int64_t n, SimTime&, SensorFrame&, auto&, ControlOutput&,
                 std::uint64_t& state) { state += n == 60 ? 1 : 0; });
  EXPECT_EQ(difference().text, "tick 60 at 0.024000 s: STATE_DIGEST differs");
}

TEST_F(LogCompare, AMessageThatOneRunLacksIsADifference) {
  writeRun(b, [](std::int64_t n, SimTime&, SensorFrame&, auto&, ControlOutput& control, auto&) {
    control.has_estimate = n != 12;
  });
  EXPECT_EQ(difference().text, "tick 12 at 0.004800 s: STATE_ESTIMATE is there in one run only");
}

TEST_F(LogCompare, AnEventAtAnotherTimeIsADifference) {
  writeRun(b, [](std::int64_t n, SimTime& time, SensorFrame&, auto&, ControlOutput&, auto&) {
    if (n == 99) time += SimDuration{100'000};
  });
  const RunDifference found = difference();
  EXPECT_EQ(found.channel, std::nullopt);
  EXPECT_EQ(found.text, "tick 99 at 0.039600 s: the other run has tick 99 at 0.039700 s instead");
}

TEST_F(LogCompare, ARunThatEndsEarlierIsNamed) {
  writeRun(
      b, [](auto&&...) {}, kTicks - 10);
  const RunDifference found = difference();
  EXPECT_EQ(found.tick, 90);
  EXPECT_EQ(found.text, "tick 90 at 0.036000 s: " + b + " ended before");
}

TEST_F(LogCompare, ALogWithoutDigestsCannotBeCompared) {
  EventLogWriter(b).close();
  EXPECT_THAT(wordsOf<InputError>([&] { compareLogs(a, b); }),
              HasSubstr("holds no TICK_DIGESTS messages, so it cannot be compared tick by tick"));
}

TEST_F(LogCompare, DenseEventsFitTheirMessages) {
  const auto dense = [](std::int64_t n, SimTime& time, auto&&...) {
    time = kSimStart + n * SimDuration{10'000};
  };
  writeRun(a, dense, 3000);
  writeRun(b, dense, 3000);
  EXPECT_EQ(compareLogs(a, b), std::nullopt);
}

}  // namespace
}  // namespace ballbot
