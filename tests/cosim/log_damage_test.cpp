// Logs with flaws: what is sound is read, what is not is counted, and where.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "cosim/event_log.hpp"
#include "cosim/log_compare.hpp"
#include "cosim/log_reader.hpp"
#include "cosim/recorder.hpp"
#include "tests/cosim/support/temporary_folder.hpp"
#include "tests/cosim/support/words.hpp"

namespace ballbot {
namespace {

using testing::HasSubstr;
using testing_support::TemporaryFolder;
using testing_support::wordsOf;

constexpr std::size_t kHeaderBytes = 28;

/// A log of 100 events of a made-up run, and where each event of the file begins.
class LogDamageTest : public testing::Test {
 protected:
  LogDamageTest() {
    RecorderOptions options;
    options.log_path = path;
    Recorder recorder(options);
    for (std::int64_t number = 0; number < 100; ++number) {
      SensorFrame sensors;
      sensors.time = kSimStart + number * SimDuration{400'000};
      std::optional<TruthFrame> truth = TruthFrame{};
      truth->time = sensors.time;
      ControlOutput control;
      recorder.record({number, sensors.time, sensors, truth, control, 7});
    }
    recorder.close();
    digest = recorder.logDigest();
    std::ifstream file(path, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), {});
    LogReader reader(path);
    LogEvent event;
    while (reader.next(event)) begins.push_back(static_cast<std::size_t>(reader.eventBegin()));
    whole = readRunLog(path);
  }
  RunLog readChanged() {
    std::ofstream(path, std::ios::binary) << bytes;
    return readRunLog(path);
  }
  std::size_t messages(const RunLog& log) {
    return log.sensors.size() + log.truth.size() + log.commands.size() + log.digests.size();
  }

  TemporaryFolder folder;
  std::string path = folder.file("log"), bytes, digest;
  std::vector<std::size_t> begins;
  RunLog whole;
};

TEST_F(LogDamageTest, AWholeLogHasNoneAndTheDigestOfItsBytes) {
  EXPECT_TRUE(whole.damage.none());
  EXPECT_EQ(messages(whole), begins.size());
  EXPECT_EQ(logDigest(path), digest);
}

TEST_F(LogDamageTest, AfterBytesThatAreNoEventItIsReadOnFromTheNextOne) {
  bytes[begins[5]] = 'x';
  const RunLog log = readChanged();
  EXPECT_EQ(messages(log), messages(whole) - 1);
  EXPECT_EQ(log.damage.places, 1);
  EXPECT_EQ(log.damage.first_byte, static_cast<std::int64_t>(begins[5]));
  EXPECT_EQ(log.damage.lost_events, 1);
  EXPECT_EQ(log.damage.lost_bytes, static_cast<std::int64_t>(begins[6] - begins[5]));
  EXPECT_THAT(log.damage.text(), HasSubstr("damaged at byte " + std::to_string(begins[5]) +
                                           ": no event begins there; events lost: 1"));
}

TEST_F(LogDamageTest, AWrongLengthCostsOneEvent) {
  for (const int bit : {0, 3, 7, 12, 25, 31}) {
    const std::string before = bytes;
    bytes[begins[7] + 24 + static_cast<std::size_t>(3 - bit / 8)] ^=
        static_cast<char>(1 << bit % 8);
    const RunLog log = readChanged();
    EXPECT_EQ(messages(log), messages(whole) - 1) << bit;
    EXPECT_EQ(log.damage.first_byte, static_cast<std::int64_t>(begins[7])) << bit;
    bytes = before;
  }
}

TEST_F(LogDamageTest, MissingEventsAreCountedByTheirNumbers) {
  const std::size_t begin = begins[10] + 3, end = begins[20] + 5;
  bytes.erase(begin, end - begin);
  const RunLog log = readChanged();
  EXPECT_EQ(messages(log), messages(whole) - 11);
  EXPECT_EQ(log.damage.first_byte, static_cast<std::int64_t>(begins[10]));
  EXPECT_GE(log.damage.lost_events, 1);
}

TEST_F(LogDamageTest, WholeEventsThatAreMissingShow) {
  bytes.erase(begins[10], begins[20] - begins[10]);
  const RunLog log = readChanged();
  EXPECT_THAT(log.damage.text(), HasSubstr("event 20 stands where event 10 is due"));
}

TEST_F(LogDamageTest, EveryBitOfAnEventCounts) {
  // Header, channel, and the beginning of the message, where all its guards are.
  for (std::size_t bit = 0; bit < 8 * (kHeaderBytes + 40); ++bit) {
    const std::size_t at = begins[30] + bit / 8;
    bytes[at] ^= static_cast<char>(1 << bit % 8);
    const RunLog log = readChanged();
    EXPECT_FALSE(log.damage.none()) << "bit " << bit;
    EXPECT_GE(messages(log), messages(whole) - 2) << "bit " << bit;
    bytes[at] ^= static_cast<char>(1 << bit % 8);
  }
}

TEST_F(LogDamageTest, ALogThatIsCutOffIsNotDamaged) {
  bytes.resize(begins[40] + 33);
  const RunLog log = readChanged();
  EXPECT_TRUE(log.cut_off);
  EXPECT_TRUE(log.damage.none()) << log.damage.text();
}

TEST_F(LogDamageTest, ComparingADamagedLogSaysWhere) {
  const std::string good = folder.file("good");
  std::filesystem::copy_file(path, good);
  bytes[begins[50] + kHeaderBytes + 30] ^= 4;
  std::ofstream(path, std::ios::binary) << bytes;
  const std::string words = wordsOf<InputError>([&] { compareLogs(good, path); });
  EXPECT_THAT(words, HasSubstr(path + ": damaged at byte " + std::to_string(begins[50])));
}

TEST_F(LogDamageTest, AForeignLogIsReadAndItsChannelsNamed) {
  {
    EventLogWriter foreign(path);
    foreign.write(kSimStart, "CAMERA", Bytes(5000, 1));
    foreign.write(kSimStart, "LIDAR", Bytes(3, 1));
    foreign.close();
  }
  const RunLog log = readRunLog(path);
  EXPECT_TRUE(log.empty());
  EXPECT_TRUE(log.damage.none());
  EXPECT_EQ(log.unknown, 2);
  EXPECT_EQ(log.unknown_channel, "CAMERA");
}

TEST_F(LogDamageTest, DigestsOfNoEventEndTheComparisonInWords) {
  ballbot_msgs::tick_digests empty{};
  Bytes encoded;
  encodeMessage(empty, encoded);
  EventLogWriter writer(path);
  writer.write(kSimStart, kTickDigestsChannel, encoded);
  writer.close();
  EXPECT_THAT(wordsOf<InputError>([&] { compareLogs(path, path); }),
              HasSubstr("TICK_DIGESTS message 0 has 0 hashes and 0 times for 0 ticks"));
}

TEST_F(LogDamageTest, ManyFalseBeginningsCostNoTime) {
  // Headers without end that each ask for all of the file.
  std::string header("\xED\xA1\xDA\x01", 4);
  header += std::string(16, '\0') + std::string("\0\0\0\0\0\x0f\xff\xff", 8);
  for (int i = 0; i < 100'000; ++i) bytes += header;
  const auto begin = std::chrono::steady_clock::now();
  const RunLog log = readChanged();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  EXPECT_EQ(messages(log), messages(whole));
  EXPECT_FALSE(log.damage.none());
}

}  // namespace
}  // namespace ballbot
