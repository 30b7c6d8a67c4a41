#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "hil/record/fault_page.hpp"
#include "hil/record/record_json.hpp"
#include "hil/record/troubleshooting_pages.hpp"
#include "hil/record/write_record.hpp"
#include "hil/rehearsal/wire_faults.hpp"
#include "tests/hil/support/rehearsed_record.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::set<std::string> kFiles = {"record.json", "fault.html", "frames.log", "frames.asc",
                                      "decoded.csv", "cycles.csv", "digests.txt"};

class RecordFolder : public ::testing::Test {
 protected:
  RecordFolder() { fs::remove_all(path); }
  ~RecordFolder() override { fs::remove_all(path); }
  const std::string path = fs::temp_directory_path() / ("record" + std::to_string(::getpid()));
};

std::string contents(const std::string& file) {
  std::ifstream in(file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

void frozenEncoder(Rehearsal& r) { r.drives().inject({0, EmulatedFault::kStuckEncoder, 2, 0}); }
void lostImu(Rehearsal& r) { r.drives().inject({0, EmulatedFault::kImuLost, 0, 0}); }

TEST(OverwritingRing, KeepsTheLastOnesInOrder) {
  OverwritingRing<int> ring(3);
  EXPECT_TRUE(ring.empty());
  for (int i = 0; i < 2; ++i) ring.push(i);
  EXPECT_EQ(ring.size(), 2U);
  EXPECT_EQ(ring[0], 0);
  for (int i = 2; i < 8; ++i) ring.push(i);
  EXPECT_EQ(ring.size(), 3U);
  EXPECT_EQ(ring.pushed(), 8U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(ring[i], 5 + static_cast<int>(i));
}

TEST(FlightRecorder, KeepsTwentySecondsAtFullRate) {
  const BenchConfig config = Rehearsal::defaultConfig();
  const FlightRecorder recorder(config, nullptr);
  EXPECT_EQ(recorder.cycles().capacity(), 8000U);
  // SYNC on two buses, 6 RPDOs, 18 TPDOs, 2 of the IMU, and heartbeats every fourth cycle.
  EXPECT_GT(recorder.frames().capacity(), 8000U * (2 + 6 + 18 + 2 + 3));
}

TEST_F(RecordFolder, HoldsWhatFiredFirstAndEveryFrame) {
  RehearsedRecord run(RunnerKind::kStepped, frozenEncoder);
  ASSERT_TRUE(run.engaged());
  const FaultRecord record = run.record();
  const WrittenRecord written = writeRecord(record, path);
  EXPECT_TRUE(written.troubles.empty());
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(written.folder)) {
    files.insert(entry.path().filename());
  }
  EXPECT_EQ(files, kFiles);
  const auto json = recordJson(record);
  EXPECT_EQ(json["first_check"]["name"], checkOf(run.rehearsal().bench().safety().fault()).name);
  EXPECT_EQ(json["first_check"]["text"], run.rehearsal().bench().faultText());
  EXPECT_EQ(json["checks"][0]["cycle"], json["first_check"]["cycle"]);
  EXPECT_EQ(json["exit_code"], 3);
  EXPECT_EQ(json["torque_off"], true);
  EXPECT_EQ(json["first_check"]["drive"], 2);
  // Every frame is in every file, in order.
  const std::string log = contents(written.folder + "/frames.log");
  const auto lines = static_cast<std::size_t>(std::count(log.begin(), log.end(), '\n'));
  EXPECT_EQ(lines, record.recorder.frames().size());
  const std::string decoded = contents(written.folder + "/decoded.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(decoded.begin(), decoded.end(), '\n')), lines + 1);
  EXPECT_THAT(decoded, HasSubstr("wheel 2,TPDO1,\"6041:00 statusword 1237 (operation enabled)"));
  EXPECT_THAT(contents(written.folder + "/cycles.csv"), HasSubstr("fault,no_voltage,"));
}

TEST_F(RecordFolder, OfASteppedRunIsTheSameBytesTwiceAndOverwritesNothing) {
  RehearsedRecord a(RunnerKind::kStepped, frozenEncoder), b(RunnerKind::kStepped, frozenEncoder);
  const WrittenRecord one = writeRecord(a.record(), path), two = writeRecord(b.record(), path);
  EXPECT_EQ(two.folder, one.folder + "-2") << "same bus time, same check";
  for (const std::string& name : kFiles) {
    EXPECT_EQ(contents(one.folder + "/" + name), contents(two.folder + "/" + name)) << name;
    EXPECT_FALSE(contents(one.folder + "/" + name).empty()) << name;
  }
}

// Which bus was read first is no part of a stepped run; what a bus carried is.
TEST(FaultRecord, OfASteppedRunHasTheFramesOfACycleBusByBus) {
  RehearsedRecord run(RunnerKind::kStepped, frozenEncoder);
  const FaultRecord record = run.record();
  const auto frames = record.frames();
  ASSERT_EQ(frames.size(), record.recorder.frames().size());
  for (std::size_t i = 1; i < frames.size(); ++i) {
    ASSERT_LE(frames[i - 1]->cycle, frames[i]->cycle);
    if (frames[i]->cycle == 0 || frames[i - 1]->cycle != frames[i]->cycle) continue;
    ASSERT_LE(frames[i - 1]->bus, frames[i]->bus) << "cycle " << frames[i]->cycle;
  }
  RehearsedRecord loop(RunnerKind::kRealTime, frozenEncoder);
  const auto in_time = loop.record().frames();
  for (std::size_t i = 1; i < in_time.size(); ++i) {
    ASSERT_LE(in_time[i - 1]->time_ns, in_time[i]->time_ns);
  }
}

// Bus time is the loop's clock; what came first is the same in both runners.
TEST_F(RecordFolder, OfTheRealTimeLoopSaysTheSame) {
  RehearsedRecord stepped(RunnerKind::kStepped, lostImu), loop(RunnerKind::kRealTime, lostImu);
  const auto a = recordJson(stepped.record()), b = recordJson(loop.record());
  EXPECT_EQ(a["first_check"]["name"], "imu_stale");
  EXPECT_EQ(b["first_check"]["name"], "imu_stale");
  const ReportData page = faultPage(loop.record());
  EXPECT_EQ(page.groups.back().axes.size(), 3U) << "with the loop's lateness and skipped periods";
  EXPECT_TRUE(writeRecord(loop.record(), path).troubles.empty());
}

TEST(FaultPage, NamesTheFirstCheckAndMarksItInEveryPlot) {
  RehearsedRecord run(RunnerKind::kStepped, lostImu);
  const ReportData page = faultPage(run.record());
  EXPECT_THAT(page.title, HasSubstr("no new IMU samples"));
  EXPECT_EQ(page.verdict, "First check: imu_stale");
  EXPECT_EQ(page.headline.front().document, "bench-imu.md");
  ASSERT_FALSE(page.phases.empty());
  EXPECT_EQ(page.phases.front().label, "first: imu_stale");
  EXPECT_EQ(page.phases.front().start_s, 0) << "time counts from it";
  ASSERT_TRUE(page.view);
  EXPECT_LT(page.view->start_s, 0);
  // The IMU's lane: samples, then none; the bench's: it damps, then takes the torque away.
  const auto& lanes = page.groups.front().lanes;
  ASSERT_EQ(lanes.size(), 8U);
  EXPECT_EQ(lanes.back().stretches.back().word, "no new sample");
  std::set<std::string> words;
  for (const LaneStretch& s : lanes.front().stretches) words.insert(s.word);
  EXPECT_TRUE(words.count("damps") == 1 && words.count("fault, torque off") == 1);
  bool marked = false;
  for (const auto& row : page.tables.back().rows) marked = marked || row.marked;
  EXPECT_TRUE(marked) << "the frames of the cycle of the decision";
}

TEST(FaultPage, OfAGoodRunSaysThatNothingFired) {
  RehearsedRecord run(RunnerKind::kStepped);
  const ReportData page = faultPage(run.record());
  EXPECT_TRUE(page.passed);
  EXPECT_EQ(page.title, "No check fired");
  EXPECT_TRUE(page.phases.empty());
}

// Drives that ignore all they are told: the record is written all the same, and says so first.
TEST_F(RecordFolder, OfADriveThatDidNotGoDownSaysThatTorqueMayBeOn) {
  RehearsedRecord run(RunnerKind::kStepped, [](Rehearsal& r) {
    changeToDrives(r, 0, rpdoOf(1, 1), put(0, 2, 0x0F));
    r.wire(0).onWayToDrives([](const CanFrame& f, std::vector<CanFrame>& out) {
      if (f.id != 0 && f.id != 0x602) out.push_back(f);  // no NMT, no questions
    });
    r.interrupt();
  });
  const auto json = recordJson(run.record());
  EXPECT_EQ(json["torque_off"], false);
  EXPECT_EQ(json["exit_code"], 5);
  EXPECT_THAT(json["last_word"].get<std::string>(), HasSubstr("node 2 (wheel 2, bus 0)"));
  const ReportData page = faultPage(run.record());
  bool said = false;
  for (const ReportFact& fact : page.headline) said = said || fact.text == "MAY BE ON";
  EXPECT_TRUE(said);
  EXPECT_TRUE(writeRecord(run.record(), path).troubles.empty());
}

// Nothing but the frames of a set-up that failed: no cycle, no check.
TEST_F(RecordFolder, OfASetUpThatFailedHasItsFrames) {
  BenchConfig config = Rehearsal::defaultConfig();
  config.drives[2].scaling.torque_reference *= 2;
  Rehearsal rehearsal(config, RunnerKind::kStepped);
  EXPECT_FALSE(rehearsal.engage());
  rehearsal.finish();
  const FaultRecord record{rehearsal.bench(), rehearsal.recorder(), {}};
  EXPECT_GT(record.recorder.frames().size(), 0U);
  EXPECT_TRUE(record.recorder.cycles().empty());
  const WrittenRecord written = writeRecord(record, path);
  EXPECT_TRUE(written.troubles.empty()) << written.troubles.front();
  EXPECT_THAT(contents(written.folder + "/decoded.csv"),
              HasSubstr("wheel 3,SDO answer,6076:00 rated torque in mNm "));
}

TEST(FaultPage, EveryCheckHasItsPageBuiltIn) {
  for (const Check& check : checkTable()) {
    if (check.fault == BenchFault::kNone) continue;
    const char* text = troubleshootingPage(check.page);
    ASSERT_NE(text, nullptr) << check.name;
    EXPECT_THAT(text, HasSubstr("# ")) << check.page;
  }
  EXPECT_EQ(troubleshootingPage("none.md"), nullptr);
}

// A disk that is full after a few kilobytes, as a limit on the size of files says it.
TEST_F(RecordFolder, OnAFullDiskSaysWhatIsMissingAndKeepsTheRest) {
  RehearsedRecord run(RunnerKind::kStepped, frozenEncoder);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{16384, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  const WrittenRecord written = writeRecord(run.record(), path);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(written.troubles.size(), 5U);
  EXPECT_THAT(written.troubles.front(), HasSubstr("fault.html: not whole: File too large"));
  EXPECT_THAT(contents(written.folder + "/record.json"), HasSubstr("\"first_check\""));
}

TEST_F(RecordFolder, ThatCannotBeMadeIsSaid) {
  std::ofstream(path) << "a file";
  RehearsedRecord run(RunnerKind::kStepped, frozenEncoder);
  const WrittenRecord written = writeRecord(run.record(), path);
  EXPECT_EQ(written.folder, "");
  ASSERT_EQ(written.troubles.size(), 1U);
  EXPECT_THAT(written.troubles[0], HasSubstr("no folder for a record can be made"));
}

}  // namespace
}  // namespace ballbot
