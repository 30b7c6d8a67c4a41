#include "cosim/recorder.hpp"

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcm/lcm.h>
#include <sys/resource.h>

#include "core/config_visitor.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "cosim/lifecycle.hpp"
#include "cosim/log_compare.hpp"
#include "cosim/log_reader.hpp"
#include "tests/cosim/support/spring_participant.hpp"
#include "tests/cosim/support/spring_run.hpp"
#include "tests/cosim/support/temporary_folder.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;
using testing_support::SpringController;
using testing_support::SpringParticipant;
using testing_support::SpringRun;
using testing_support::TemporaryFolder;
using testing_support::wordsOf;

constexpr SimDuration kTenthOfASecond{100'000'000};

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void writeBytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Runs a spring and returns the digest.
std::string recordedRun(const std::string& log_path, std::uint64_t seed = 1,
                        SimDuration duration = kTenthOfASecond) {
  SpringParticipant spring(seed);
  Lifecycle guarded(spring);
  return SpringRun(guarded, duration, log_path).finish();
}

/// The same with recorder options of its own.
std::string recordedRun(const RecorderOptions& options) {
  SpringParticipant spring;
  Lifecycle guarded(spring);
  EventCalendar calendar;
  const TaskId tracker = calendar.addTask("tracker", SimDuration{400'000});
  const TaskId planner = calendar.addTask("planner", SimDuration{2'500'000});
  SpringController controller(tracker, planner);
  Recorder recorder(options);
  StepMaster(guarded, controller, calendar, &recorder, {kSimStart, kSimStart + kTenthOfASecond})
      .run();
  recorder.close();
  return recorder.trajectoryDigest();
}

TEST(Recorder, TheSameRunWritesTheSameBytes) {
  const TemporaryFolder folder;
  EXPECT_EQ(recordedRun(folder.file("a")), recordedRun(folder.file("b")));
  EXPECT_EQ(bytesOf(folder.file("a")), bytesOf(folder.file("b")));
}

TEST(Recorder, LcmsOwnReaderReadsTheLogInSimulatedTime) {
  const TemporaryFolder folder;
  recordedRun(folder.file("log"));
  lcm_eventlog_t* log = lcm_eventlog_create(folder.file("log").c_str(), "r");
  ASSERT_NE(log, nullptr);
  std::int64_t events = 0, last_time = 0;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    EXPECT_EQ(event->eventnum, events++);
    EXPECT_GE(event->timestamp, last_time);
    last_time = event->timestamp;
    if (std::string(event->channel) == "SENSOR_FRAME") {
      ballbot_msgs::sensor_frame frame{};
      ASSERT_GT(frame.decode(event->data, 0, event->datalen), 0);
      EXPECT_EQ(frame.sim_time_ns / 1000, event->timestamp);
    }
    lcm_eventlog_free_event(event);
  }
  lcm_eventlog_destroy(log);
  EXPECT_EQ(last_time, 100'000);
  // 41 each of sensors, truth and commands, 8 estimates and plans, 11 digests.
  EXPECT_EQ(events, 3 * 41 + 2 * 8 + 11);
}

TEST(Recorder, LogsWhatTheEstimatorConsumedAtItsPeriod) {
  const TemporaryFolder folder;
  recordedRun(folder.file("log"));
  const RunLog log = readRunLog(folder.file("log"));
  ASSERT_EQ(log.sensors.size(), 41U);
  for (std::size_t i = 0; i < log.sensors.size(); ++i) {
    EXPECT_EQ(toNs(log.sensors[i].time), static_cast<std::int64_t>(i) * 2'500'000);
  }
  EXPECT_EQ(log.truth.size(), 41U);
  EXPECT_EQ(log.commands.size(), 41U);
  EXPECT_EQ(log.plans.size(), 8U);  // every one: 0, 14, ... 98 ms
  EXPECT_EQ(log.unknown, 0);
  EXPECT_FALSE(log.cut_off);
}

TEST(Recorder, WhatIsLoggedNeverChangesTheDigest) {
  const TemporaryFolder folder;
  RecorderOptions everything;
  everything.log_path = folder.file("everything");
  everything.sensors = everything.truth = everything.estimate = everything.command = SimDuration{0};
  RecorderOptions little;
  little.log_path = folder.file("little");
  little.sensors = SimDuration{50'000'000};
  little.truth = little.estimate = little.plan = little.command = SimDuration{-1'000'000};
  const std::string digest = recordedRun(RecorderOptions{});
  EXPECT_EQ(recordedRun(everything), digest);
  EXPECT_EQ(recordedRun(little), digest);

  EXPECT_EQ(readRunLog(everything.log_path).sensors.size(), 281U);
  const RunLog log = readRunLog(little.log_path);
  EXPECT_EQ(log.sensors.size(), 3U);
  EXPECT_EQ(log.truth.size() + log.commands.size() + log.plans.size(), 0U);
  EXPECT_EQ(compareLogs(everything.log_path, little.log_path), std::nullopt);
}

TEST(Recorder, TheDefaultsStayUnderTwoMegabytesPerSimulatedSecond) {
  const TemporaryFolder folder;
  recordedRun(folder.file("log"), 1, SimDuration{1'000'000'000});
  const auto size = std::filesystem::file_size(folder.file("log"));
  EXPECT_LT(size, 2'000'000U);
  EXPECT_GT(size, 100'000U);
}

TEST(Recorder, PeriodsComeFromTheConfiguration) {
  const ConfigNode node = parseYaml("sensors_period_ms: 10\ntruth_period_ms: -1\n", "test.yaml");
  ConfigReader in(node);
  RecorderOptions options;
  readDescribed(in, options);
  in.finish();
  EXPECT_EQ(options.sensors, SimDuration{10'000'000});
  EXPECT_LT(options.truth.count(), 0);
  EXPECT_EQ(options.command, SimDuration{2'500'000});
}

TEST(Recorder, AFolderThatIsNotThereIsAnOutputError) {
  EXPECT_THAT(wordsOf<OutputError>([] { EventLogWriter log("/nowhere/at/all.lcmlog"); }),
              HasSubstr("/nowhere/at/all.lcmlog: cannot be created: No such file or directory"));
}

TEST(Recorder, AFullDiskIsAnOutputErrorInWords) {
  EXPECT_THAT(wordsOf<OutputError>([] { recordedRun("/dev/full"); }),
              HasSubstr("/dev/full: cannot be written: No space left on device"));
}

TEST(Recorder, WhatTheDiskTookBeforeItWasFullIsReadable) {
  const TemporaryFolder folder;
  // A limit on the size of files stands for the end of the disk; it falls into the middle of an
  // event.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 100'001;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string words =
      wordsOf<OutputError>([&] { recordedRun(folder.file("log"), 1, SimDuration{1'000'000'000}); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);

  EXPECT_THAT(words, HasSubstr("cannot be written: File too large"));
  EXPECT_THAT(words, HasSubstr("bytes of the log are there and readable"));
  const RunLog log = readRunLog(folder.file("log"));
  EXPECT_FALSE(log.cut_off);
  EXPECT_GT(log.sensors.size(), 40U);
  EXPECT_EQ(log.unknown, 0);
}

TEST(LogReader, ALogIsReadableWhereverItIsCut) {
  const TemporaryFolder folder;
  const std::string path = folder.file("log");
  recordedRun(path, 1, SimDuration{1'000'000});
  std::vector<std::size_t> ends{0};
  {
    LogReader reader(path);
    LogEvent event;
    while (reader.next(event)) {
      ends.push_back(ends.back() + 28 + event.channel.size() + event.data.size());
    }
    ASSERT_EQ(ends.back(), std::filesystem::file_size(path));
    ASSERT_GT(ends.size(), 5U);
  }
  std::size_t whole = ends.size() - 1;
  for (std::size_t size = ends.back(); size-- > 0;) {
    if (size < ends[whole]) --whole;
    std::filesystem::resize_file(path, size);
    LogReader reader(path);
    LogEvent event;
    std::size_t read = 0;
    while (reader.next(event)) ++read;
    ASSERT_EQ(read, whole) << "cut at " << size;
    ASSERT_EQ(reader.cutOff(), size != ends[whole]) << "cut at " << size;
  }
}

TEST(LogReader, SaysWhatIsWrongWithAFile) {
  const TemporaryFolder folder;
  EXPECT_THAT(wordsOf<InputError>([&] { LogReader reader(folder.file("none")); }),
              HasSubstr("none: cannot be opened"));
  writeBytes(folder.file("text"), std::string(100, 'x'));
  EXPECT_THAT(wordsOf<InputError>([&] { readRunLog(folder.file("text")); }),
              HasSubstr("text: not an LCM event log"));
}

TEST(LogReader, ADamagedMessageIsCountedNotBelieved) {
  const TemporaryFolder folder;
  recordedRun(folder.file("log"));
  std::string bytes = bytesOf(folder.file("log"));
  bytes[28 + std::string("SENSOR_FRAME").size() + 100] ^= 1;  // in the data of the first event
  writeBytes(folder.file("damaged"), bytes);
  const RunLog log = readRunLog(folder.file("damaged"));
  EXPECT_EQ(log.damage.text(),
            "damaged at byte 0: its SENSOR_FRAME message is damaged; events lost: 1");
  EXPECT_EQ(log.sensors.size(), 40U);
}

}  // namespace
}  // namespace ballbot
