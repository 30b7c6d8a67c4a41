// The bench as a person runs it: programs of their own, joined by LCM and pseudo terminals.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "tests/tools/program.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string kConfigs = std::string(BALLBOT_SOURCE_DIR) + "/configs/";
const std::string kBench = kConfigs + "hil/bench.yaml";

/// `ballbot drives` on links of its own.
class Drives {
 public:
  explicit Drives(std::vector<std::string> extra = {}, const std::string& config = kBench) {
    std::vector<std::string> arguments{"drives", config, "--json"};
    for (const std::string n : {"0", "1"}) {
      const std::string link = base() + n;
      more_.insert(more_.end(), {"--set", "buses." + n + ".address=\"slcan:" + link + "\""});
      arguments.insert(arguments.end(), {"--set", "emulator.buses." + n + ".link=" + link});
    }
    more_.insert(more_.end(), extra.begin(), extra.end());
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    program_ = std::make_unique<Program>(arguments);
    for (int i = 0; i < 600 && ::access((base() + "1").c_str(), F_OK) != 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  static std::string base() { return "/tmp/ballbot-test-can" + std::to_string(::getpid()) + "-"; }
  /// Arguments with which other verbs find these drives.
  std::vector<std::string> with(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), more_.begin(), more_.end());
    return arguments;
  }
  Json finish() {
    program_->signal(SIGINT);
    const Finished f = program_->finish();
    EXPECT_EQ(f.exit_code, 0) << f.err;
    return Json::parse(f.out);
  }

 private:
  std::vector<std::string> more_;
  std::unique_ptr<Program> program_;
};

TEST(BenchPrograms, ControllerHilAndDrivesBalanceTheRobot) {
  Drives drives;
  const std::string channel = "HILTEST" + std::to_string(::getpid());
  Program hil(drives.with({"hil", kBench, "--json", "--channel", channel}));
  const TemporaryFolder folder;
  const Finished controller =
      runBallbot({"controller", kConfigs + "scenarios/bench_balance.yaml", "--channel", channel,
                  "--out", folder / "run", "--no-report", "--quiet"});
  EXPECT_EQ(controller.exit_code, 0) << controller.err;
  const Finished bench = hil.finish();
  EXPECT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_THAT(bench.err, HasSubstr("this program is no emergency stop"));
  const Json report = Json::parse(bench.out);
  EXPECT_EQ(report["state"], "disabled");
  EXPECT_EQ(report["fault"], "");
  EXPECT_EQ(report["bad_pdos"], 0);
  const Json robot = drives.finish();
  EXPECT_GT(robot["robot_s"], 3.9);
  // With the last 0.2 s, in which the bench only damps and the robot leans over.
  EXPECT_LT(robot["largest_tilt_deg"], 10);
  EXPECT_FALSE(robot["torque_on"]);
}

TEST(BenchPrograms, AFaultOfADriveEndsTheRunWithItsReason) {
  Drives drives(
      {"--set", "emulator.faults=[{at_cycle: 150, kind: emergency, drive: 2, value: 17168}]"});
  const std::string channel = "HILFAULT" + std::to_string(::getpid());
  const TemporaryFolder folder;
  Program hil(drives.with({"hil", kBench, "--channel", channel, "--records", folder / "records"}));
  const Finished controller =
      runBallbot({"controller", kConfigs + "scenarios/bench_balance.yaml", "--channel", channel,
                  "--out", folder / "run", "--no-report", "--quiet"});
  EXPECT_EQ(controller.exit_code, 3);
  EXPECT_THAT(controller.err, HasSubstr("wheel 2: node 2: emergency 4310 (drive too hot)"));
  const Finished bench = hil.finish();
  EXPECT_EQ(bench.exit_code, 3);
  EXPECT_FALSE(drives.finish()["torque_on"]);
  // It says where its last seconds are, and reads them again.
  const std::filesystem::directory_iterator records(folder / "records");
  const std::string record = records->path();
  EXPECT_THAT(bench.err, HasSubstr(record + "/fault.html"));
  const Finished shown = runBallbot({"hil", "--show-record", record});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("first check: node_trouble, cycle "));
  EXPECT_THAT(shown.out, HasSubstr("EMCY         4310 (drive too hot), error register 89"));
  const Finished as_json = runBallbot({"hil", "--show-record", record, "--json"});
  EXPECT_EQ(Json::parse(as_json.out)["first_check"]["subject"], "wheel 2");
  EXPECT_EQ(Json::parse(as_json.out)["exit_code"], 3);
  std::filesystem::rename(record + "/cycles.csv", record + "/elsewhere");
  std::ofstream(record + "/decoded.csv", std::ios::app) << "more\n";
  const Finished in_pieces = runBallbot({"hil", "--show-record", record});
  EXPECT_EQ(in_pieces.exit_code, 2);
  EXPECT_THAT(in_pieces.err, HasSubstr("cycles.csv is missing; decoded.csv is not as it was"));
  const Finished none = runBallbot({"hil", "--show-record", folder / "run"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("record.json: cannot be read; give the folder of a record"));
  std::ofstream(record + "/record.json") << "{\"format\": 1, \"zero_s\": \"soon\"}";
  const Finished damaged = runBallbot({"hil", "--show-record", record});
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.err, HasSubstr("not the record of a bench"));
}

// People press Ctrl-C twice. The second one may not end the way down.
TEST(BenchPrograms, ASecondCtrlCDoesNotLeaveTorqueOn) {
  Drives drives;
  const std::string channel = "HILTWICE" + std::to_string(::getpid());
  const TemporaryFolder folder;
  Program hil(drives.with({"hil", kBench, "--channel", channel, "--records", folder / "records"}));
  Program controller({"controller", kConfigs + "scenarios/bench_balance.yaml", "--channel", channel,
                      "--out", folder / "run", "--no-report", "--set", "duration_s=60"});
  for (int i = 0; i < 600 && controller.errSoFar().find("0 %") == std::string::npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  for (int i = 0; i < 4; ++i) {
    hil.signal(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const Finished bench = hil.finish();
  EXPECT_EQ(bench.exit_code, 130) << bench.err << bench.out;
  controller.finish();
  EXPECT_FALSE(drives.finish()["torque_on"]);
}

TEST(BenchPrograms, IdentifyDoesNotWriteOverWhatItReads) {
  const std::string stand = kConfigs + "hil/stand.yaml";
  const Finished f = runBallbot({"identify", stand, "--drive", "1", "--bench-out", stand});
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("--bench-out"));
  EXPECT_THAT(f.err, HasSubstr("this file is read, and would be lost"));
  const Finished nowhere =
      runBallbot({"identify", stand, "--drive", "1", "--figure", "/proc/nowhere/figure.svg"});
  EXPECT_EQ(nowhere.exit_code, 4) << nowhere.err;
}

TEST(BenchPrograms, OneThingIsDoneAtATime) {
  for (const std::vector<std::string>& both :
       {std::vector<std::string>{"hil", kBench, "--random", "3"},
        {"hil", "--checks", "--faults"},
        {"hil", kBench, "--check", "--commission"},
        {"hil", kBench, "--check", "--keep-serving"},
        {"hil", kBench, "--rehearse"}}) {
    const Finished f = runBallbot(both);
    EXPECT_EQ(f.exit_code, 2) << f.out << f.err;
  }
}

// What a full disk does not take is said; the fault's exit code stays.
TEST(BenchPrograms, AFullDiskLosesNothingButTheRecord) {
  Drives drives({"--set",
                 "emulator.faults=[{at_cycle: 150, kind: emergency, drive: 2, value: 17168}]",
                 "--set", "emulator.rig={blocked: true}"});
  const TemporaryFolder folder;
  constexpr long kSmall = 8192;
  Program identify(drives.with({"identify", kBench, "--records", folder / "records"}), kSmall);
  const Finished f = identify.finish();
  EXPECT_EQ(f.exit_code, 3) << f.err;
  EXPECT_THAT(f.err, HasSubstr("RECORD INCOMPLETE: "));
  EXPECT_THAT(f.err, HasSubstr("fault.html: not whole: File too large"));
  EXPECT_FALSE(drives.finish()["torque_on"]);
}

// A good run leaves a record where one is wanted, and only there.
TEST(BenchPrograms, AGoodRunLeavesARecordOnRequest) {
  Drives drives({"--set", "emulator.rig={blocked: true}"});
  const TemporaryFolder folder;
  const std::vector<std::string> identify = {"identify", kBench,      "--record-s",
                                             "0.5",      "--records", folder / "records"};
  EXPECT_EQ(runBallbot(drives.with(identify)).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "records"));
  std::vector<std::string> kept = identify;
  kept.push_back("--keep-record");
  const Finished f = runBallbot(drives.with(kept));
  EXPECT_EQ(f.exit_code, 0) << f.err;
  const std::filesystem::directory_iterator records(folder / "records");
  EXPECT_THAT(records->path().filename().string(), ::testing::StartsWith("bench-kept-"));
  const Finished shown = runBallbot({"hil", "--show-record", records->path()});
  EXPECT_THAT(shown.out, HasSubstr("first check: none fired"));
  drives.finish();
}

TEST(BenchPrograms, CheckFindsSevenNodesAndNamesWhatDiffers) {
  Drives drives;
  const Finished good = runBallbot(drives.with({"hil", kBench, "--check", "--json"}));
  EXPECT_EQ(good.exit_code, 0) << good.out << good.err;
  EXPECT_EQ(Json::parse(good.out)["nodes"].size(), 7U);
  const Finished bad = runBallbot(
      drives.with({"hil", kBench, "--check", "--set", "drive_defaults.rated_torque_Nm=10"}));
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.out, HasSubstr("DIFFERS: rated torque [Nm] is 20, configured 10"));
  drives.finish();
}

TEST(BenchPrograms, DrivesThatMayBeRealAreNotServedBeforeTheyWereCommissioned) {
  const std::string bench = kConfigs + "hil/bench_realtime.yaml";
  const Drives drives(
      {"--set", "emulator.drive_defaults.product_code=47648", "--set", "drive_defaults.eds=null"},
      bench);
  const std::string channel = "HILTEST" + std::to_string(::getpid());
  const TemporaryFolder folder;
  const auto serve = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"hil", bench, "--floor-seconds", "0", "--channel", channel};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runBallbot(drives.with(arguments), 30);
  };
  const Finished bare = serve({"--commissioning-record", folder / "none.json"});
  EXPECT_EQ(bare.exit_code, 2);
  EXPECT_THAT(bare.err, HasSubstr("no record that this bench was commissioned"));
  const Finished mute = serve({"--without-commissioning", "no"});
  EXPECT_EQ(mute.exit_code, 2);
  EXPECT_THAT(mute.err, HasSubstr("needs a reason in words"));
  const Finished nobody = serve({"--commission"});
  EXPECT_EQ(nobody.exit_code, 2);
  EXPECT_THAT(nobody.err, HasSubstr("--person"));
}

TEST(BenchPrograms, FaultTableHolds) {
  const Finished f = runBallbot({"hil", "--faults", "--json"});
  EXPECT_EQ(f.exit_code, 0) << f.out;
  const Json table = Json::parse(f.out);
  EXPECT_TRUE(table["held"]);
  EXPECT_GE(table["rows"].size(), 20U);
}

TEST(BenchPrograms, IdentifyRecoversTheResponseOfATestStand) {
  Drives drives(
      {"--set", "emulator.rig={blocked: true, natural_frequency_Hz: 30, damping_ratio: 0.6}"});
  const Finished f = runBallbot(drives.with({"identify", kBench, "--drive", "2", "--json"}));
  ASSERT_EQ(f.exit_code, 0) << f.err;
  const Json fit = Json::parse(f.out)["second_order"];
  EXPECT_NEAR(fit["natural_frequency_Hz"], 30, 0.05 * 30);
  EXPECT_NEAR(fit["damping_ratio"], 0.6, 0.05);
  EXPECT_THAT(f.err, HasSubstr("bench_balance.yaml has no MPC"));
  drives.finish();
}

// From bench to MPC: the plant's series elastic drive in the stand, at 50 Hz instead of the 40 Hz
// that everything else in the configuration believes in.
TEST(BenchPrograms, IdentifyFindsThePlantsDriveAndWritesAScenarioForIt) {
  Drives drives(
      {"--set", "set=[initial.release_s=60, robot.actuators.wheel.torque_bandwidth_Hz=50]"});
  const TemporaryFolder folder;
  const std::string yaml = folder / "wheel.yaml", svg = folder / "wheel.svg";
  const Finished f = runBallbot({"identify", kBench, "--drive", "2", "--out", yaml, "--figure", svg,
                                 "--json", "--scenario", kConfigs + "scenarios/balance.yaml",
                                 "--set", "buses.0.address=\"slcan:" + Drives::base() + "0\"",
                                 "--set", "buses.1.address=\"slcan:" + Drives::base() + "1\""});
  ASSERT_EQ(f.exit_code, 0) << f.err;
  EXPECT_NEAR(Json::parse(f.out)["torque_bandwidth_Hz"], 50, 0.05 * 50);
  EXPECT_THAT(readFile(svg), HasSubstr("Torque response of wheel 2"));
  const Finished bode = runBallbot({"bode", yaml, "--json"});
  ASSERT_EQ(bode.exit_code, 0) << bode.err;
  const Json loop = Json::parse(bode.out);
  const double wanted = loop["actuators"]["wheel"]["wanted_bandwidth_Hz"];
  EXPECT_NEAR(wanted, 50, 0.05 * 50);
  EXPECT_EQ(loop["actuators"]["arm"]["wanted_bandwidth_Hz"], 40) << "the other group is left alone";
  EXPECT_NEAR(loop["shaping"]["zero_rad_per_s"], 0.4 * 6.2832 * wanted, 0.1);
  const Finished run = runBallbot(
      {"run", yaml, "--set", "duration_s=0.2", "--out", folder / "run", "--no-report", "--quiet"});
  EXPECT_NE(run.exit_code, 2) << run.err;
  drives.finish();
}

// The shipped stand, over its pseudo terminals, in all postures: figures, files, and what reads
// them.
TEST(BenchPrograms, IdentifyFindsTheStandsDriveAndWritesDriveScenarioAndBench) {
  const std::string stand = kConfigs + "hil/stand.yaml";
  Drives drives({}, stand);
  const TemporaryFolder folder;
  const std::string scenario = folder / "wheel.yaml", actuator = folder / "drive.yaml",
                    bench = folder / "bench.yaml";
  const Finished f = runBallbot(drives.with(
      {"identify", stand, "--drive", "3", "--scenario", kConfigs + "scenarios/balance.yaml",
       "--out", scenario, "--actuator-out", actuator, "--bench-out", bench, "--json"}));
  ASSERT_EQ(f.exit_code, 0) << f.err;
  EXPECT_THAT(f.err, HasSubstr("wheel 3, output back-driven: up to 3.8 Nm for 20 s"));
  const Json found = Json::parse(f.out);
  EXPECT_TRUE(found["valid"]);
  EXPECT_EQ(found["held_out"].size(), 4U);
  const Json& figures = found["figures"];
  EXPECT_NEAR(figures["stiffness_Nm_per_rad"]["value"], 350, 0.05 * 350);
  EXPECT_NEAR(figures["rotor_inertia_kgm2"]["value"], 0.1, 0.05 * 0.1);
  EXPECT_NEAR(figures["backlash_deg"]["value"], 0.1, 0.05 * 0.1);
  EXPECT_EQ(figures["rotor_inertia_kgm2"]["verdict"], "agrees");
  EXPECT_EQ(figures["load_friction"]["verdict"], "differs");
  EXPECT_EQ(found["correlation"]["matrix"].size(), 9U);
  EXPECT_NEAR(found["correlation"]["matrix"][4][4], 1, 1e-9);
  EXPECT_THAT(readFile(actuator), HasSubstr("#   rotor inertia"));
  const Finished bode = runBallbot({"bode", scenario, "--json"});
  ASSERT_EQ(bode.exit_code, 0) << bode.err;
  EXPECT_NEAR(Json::parse(bode.out)["actuators"]["wheel"]["wanted_bandwidth_Hz"],
              found["torque_bandwidth_Hz"].get<double>(), 0.01);
  const Finished check = runBallbot(drives.with({"hil", bench, "--check", "--json"}));
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_FALSE(drives.finish()["torque_on"]);
}

TEST(BenchPrograms, IdentifyAsksAPersonOnlyAtATerminal) {
  Drives drives({"--set", "emulator.rig={blocked: true}"});
  const Finished f = runBallbot(drives.with({"identify", kBench, "--drive", "4", "--seeds", "2"}));
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("no rig with elastic actuators"));
  const Finished response =
      runBallbot(drives.with({"identify", kBench, "--drive", "4", "--response-only"}));
  EXPECT_EQ(response.exit_code, 0) << response.err;
  EXPECT_THAT(response.out, HasSubstr("not identified: the drive shows no motor current"));
  drives.finish();
}

// What a busy machine may do to a run by the wall clock is end it with its reason; it may not leave
// torque on.
TEST(BenchPrograms, RealTimeRunsOrSaysWhyNotAndStopsWithTheDrivesOff) {
  Drives drives({"--set", "stepped=false", "--set", "emulator.rig={blocked: true}", "--set",
                 "realtime={collect_us: 2000, act_us: 2200}", "--set",
                 "safety={late_cycles: 100, stale_cycles: 100, heartbeat_timeout_ms: 2000, "
                 "transition_timeout_ms: 5000, command_watchdog_ms: 5000}",
                 "--set", "master_timeout_ms=1000", "--set", "output_deadline_ms=1000"});
  const TemporaryFolder folder;
  const Finished f = runBallbot(drives.with({"identify", kBench, "--drive", "1", "--record-s",
                                             "0.5", "--json", "--records", folder / "records"}));
  if (f.exit_code == 0) {
    const Json report = Json::parse(f.out);
    EXPECT_EQ(report["bench"]["state"], "disabled");
    EXPECT_GT(report["realtime"]["cycles"], 600) << "three records of 200 cycles";
    EXPECT_FALSE(report["realtime"]["granted"].get<std::string>().empty());
    const Json& latency = report["realtime"]["latency"];
    EXPECT_EQ(latency["own_loop"]["whole"]["count"], report["realtime"]["cycles"]);
    EXPECT_EQ(latency["drives"].size(), 7U);
    EXPECT_GT(latency["buses"][1]["answers"]["count"], 0);
    EXPECT_EQ(latency["buses"][1]["has_wire"], false) << "a pseudo terminal";
  } else {
    // 1: a machine that was late in the held-out record, which then fits no model.
    EXPECT_THAT(f.exit_code, ::testing::AnyOf(1, 3)) << f.err;
    EXPECT_THAT(f.err, ::testing::AnyOf(HasSubstr("bench: stopped"), HasSubstr("no drive of"),
                                        HasSubstr("no model"), HasSubstr("does not fit record")));
  }
  EXPECT_FALSE(drives.finish()["torque_on"]);
}

}  // namespace
}  // namespace ballbot
