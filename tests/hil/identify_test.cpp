// Identification end to end: excitation over the bench's bus, records, fits, figures, files.
#include "hil/identify/identify.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "core/config_reader.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "hil/bench_check.hpp"
#include "hil/emulator/emulated_bus.hpp"
#include "hil/emulator/joint_rig.hpp"
#include "hil/identify/configuration.hpp"
#include "hil/identify/stand.hpp"
#include "hil/identify/take_records.hpp"
#include "hil/rehearsal/identify_trials.hpp"
#include "hil/stepped_runner.hpp"
#include "model/actuator_response.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

ConfigNode benchTree(const std::string& extra, const std::string& rig = "{}") {
  return parseYaml(
      "{stepped: true, buses: [{address: none}], drives: [{node: 1}, {node: 2}, "
      "{node: 3}, {node: 4}, {node: 5}, {node: 6}], emulator: {buses: [{link: a}], rig: " +
          rig + "}" + extra + "}",
      "stand");
}

/// A bench with joints on a blocked test stand, known exactly; they show no motor current.
struct Stand {
  explicit Stand(const JointRigOptions& rig, const std::string& extra = "")
      : tree(benchTree(extra)),
        config(forIdentification(readBenchConfig(tree), false)),
        drives(readEmulatorConfig(tree), std::make_unique<JointRig>(rig)),
        bus(drives, 0),
        runner(config, {&bus}) {
    drives.powerOn();
  }
  ConfigNode tree;
  BenchConfig config;
  EmulatedBench drives;
  EmulatedBus bus;
  SteppedRunner runner;
};

TEST(IdentifyDrive, RecoversTheEmulatedDrivesBandwidthWithinFivePercent) {
  for (const JointRigOptions rig :
       {JointRigOptions{40, 0.7071, 0, true}, JointRigOptions{20, 0.5, 0.001, true},
        JointRigOptions{80, 0.9, 0.0025, true}}) {
    Stand stand(rig);
    ExcitationPlan plan;
    plan.drive = 2;
    const std::vector<Record> records = takeRecords(stand.runner, Posture::kBlocked, plan);
    ASSERT_EQ(records.size(), 3U) << "without current only the response";
    for (const double sent : records[0].sent) ASSERT_LE(std::abs(sent), plan.amplitude_Nm + 1e-9);
    const Identification found = identify(records, {});
    EXPECT_FALSE(found.has_current);
    EXPECT_TRUE(found.valid()) << found.complaint();
    const TorqueResponse truth{2, kTwoPi * rig.bandwidth_Hz, rig.damping_ratio, rig.delay_s};
    EXPECT_NEAR(found.second.bandwidth_Hz(), truth.bandwidth_Hz(), 0.05 * truth.bandwidth_Hz());
    EXPECT_NEAR(found.second.damping_ratio, rig.damping_ratio, 0.05);
    EXPECT_NEAR(found.second.delay, rig.delay_s, 3e-4);
    EXPECT_LT(found.second.residual, 0.02);
    EXPECT_GT(found.first.residual, found.second.residual) << "a second order fits better";
    EXPECT_FALSE(stand.drives.anyEnergized());
    EXPECT_EQ(found.figures.at("stiffness_Nm_per_rad").why, "the drive shows no motor current");
    EXPECT_EQ(found.figures.at("bandwidth_Hz").value, found.second.bandwidth_Hz());
  }
}

TEST(IdentifyDrive, KeepsToTheLimits) {
  Stand stand({40, 0.7, 0, true});
  ExcitationPlan plan;
  plan.amplitude_Nm = 5;
  try {
    takeRecords(stand.runner, Posture::kBlocked, plan);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("5 Nm exceed the limit of wheel 1, 4 Nm"));
  }
  plan = {};
  plan.record_s = 0.05;
  try {
    takeRecords(stand.runner, Posture::kBlocked, plan);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("torque grows over ramp_ms, 0.1 s, longer than the 0.05 s"));
  }
  plan = {};
  plan.high_Hz = 200;
  EXPECT_THROW(takeRecords(stand.runner, Posture::kBlocked, plan), InputError);
}

TEST(IdentifyDrive, LeavesTheDrivesOffWhenInterrupted) {
  Stand stand({40, 0.7, 0, true});
  const std::atomic<bool> stop{true};
  EXPECT_THROW(takeRecords(stand.runner, Posture::kBlocked, {}, &stop), InterruptedError);
  EXPECT_FALSE(stand.drives.anyEnergized());
}

TEST(IdentifyDrive, HasNoRoomToSwingBetweenTwoStops) {
  Stand stand({40, 0.7, 0, false},
              ", drive_defaults: {position_low_deg: -20, position_high_deg: 20}");
  try {
    takeRecords(stand.runner, Posture::kFree, {});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("no room to turn by 57.3 deg between -20 and 20 deg"));
  }
  EXPECT_FALSE(stand.drives.anyEnergized());
}

TEST(IdentifyDrive, MapsTheMotorsCurrentWhereThereIsRoom) {
  const BenchConfig plain = readBenchConfig(benchTree(""));
  const BenchConfig with = forIdentification(plain, true);
  EXPECT_EQ(forIdentification(plain, false).inputs.size(), plain.inputs.size());
  EXPECT_EQ(with.inputs.size(), plain.inputs.size());
  EXPECT_TRUE(with.inputs.back().find({0x6078, 0})) << "beside the torque demand";
  const std::string full = "[60410010, 60770010, 60640020]";
  const BenchConfig crowded = readBenchConfig(
      benchTree(", tpdo: [" + full +
                ", [606C0020, 60E40120], [60740010, 60410010, 60640020], [60640020, 606C0020]]"));
  EXPECT_THROW(forIdentification(crowded, true), InputError);
}

/// The shipped stand's figures.
const char* const kRig =
    "{elastic: {load_friction: 0.08, backlash_deg: 0.1, delay_ms: 1.2, motor_angle_noise_deg: "
    "0.001, joint_angle_noise_deg: 0.006, motor_torque_noise_Nm: 0.1}}";

struct Elastic {
  explicit Elastic(const std::string& rig = kRig)
      : tree(benchTree("", rig)),
        bench(readBenchConfig(tree)),
        emulator(readEmulatorConfig(tree)) {}
  ConfigNode tree;
  BenchConfig bench;
  EmulatorConfig emulator;
};

/// Records of the shipped stand's drive, taken once.
const std::vector<Record>& standRecords() {
  static const std::vector<Record> records = [] {
    const Elastic e;
    return recordsOnStand(e.bench, e.emulator, {});
  }();
  return records;
}

std::vector<Record> withoutPosture(Posture posture) {
  std::vector<Record> out;
  for (const Record& r : standRecords()) {
    if (r.posture != posture) out.push_back(r);
  }
  return out;
}

// 50 seeds: ballbot identify configs/hil/stand.yaml --seeds 50.
TEST(Identify, FindsEveryFigureOfTheStandWithinFivePercentOrTwoSigma) {
  const Elastic e;
  const IdentifyTrials trials = tryIdentification(e.bench, e.emulator, {}, {}, 3);
  EXPECT_EQ(trials.invalid, 0);
  ASSERT_EQ(trials.figures.size(), 9U);
  int good = 0;
  for (const FigureTrials& f : trials.figures) {
    good += f.good();
    for (std::size_t i = 0; i < f.values.size(); ++i) {
      EXPECT_LT(std::abs(f.values[i] - f.truth), std::max(0.05 * f.truth, 3.5 * f.sigmas[i]))
          << f.name;
      EXPECT_LT(f.sigmas[i], 0.15 * f.truth) << f.name << " is found, not guessed";
    }
  }
  EXPECT_GE(good, 26) << "of 27, one in twenty may lie beyond two sigma";
  EXPECT_GT(trials.rmsZ(), 0.6);
  EXPECT_LT(trials.rmsZ(), 1.5);
}

TEST(Identify, FindsNothingWhereThereIsNothing) {
  const Elastic e(
      "{elastic: {motor_angle_noise_deg: 0.001, joint_angle_noise_deg: 0.006, "
      "motor_torque_noise_Nm: 0.1}}");
  const Identification found = identify(recordsOnStand(e.bench, e.emulator, {}), {});
  for (const char* key : {"load_friction", "backlash_deg", "delay_ms"}) {
    const Figure& f = found.figures.at(key);
    EXPECT_TRUE(f.identified);
    EXPECT_LT(std::abs(f.value), 3 * f.sigma) << key;
  }
  EXPECT_LT(found.figures.at("backlash_deg").sigma, 0.005);
  EXPECT_LT(found.figures.at("load_friction").sigma, 0.01);
  EXPECT_LT(found.figures.at("delay_ms").sigma, 0.2);
}

// A drive unlike the shipped one in everything, with other encoders and the other direction.
TEST(Identify, FindsAnotherDrive) {
  Elastic e;
  ElasticJointParameters& j = e.emulator.elastic_rig->joint;
  j.actuator.motor_inertia = 6e-5;
  j.actuator.viscous_friction = 0.6;
  j.actuator.coulomb_friction = 0.25;
  j.actuator.static_friction = 0.3;
  j.actuator.torque_bandwidth = 30;
  j.load_friction = 0.15;
  j.backlash = 0.2 * kRadPerDeg;
  j.command_delay = 3.1e-3;
  e.emulator.drives[1].sign = -1;
  e.bench.drives[1].scaling.sign = -1;
  ExcitationPlan plan;
  plan.drive = 1;
  const Identification found = identify(recordsOnStand(e.bench, e.emulator, plan), {});
  EXPECT_TRUE(found.valid()) << found.complaint();
  for (const Figure& f : found.figures.list) {
    const double truth = trueFigure(j, f.key);
    EXPECT_LT(std::abs(f.value - truth), std::max(0.05 * truth, 3 * f.sigma)) << f.name;
  }
}

TEST(Identify, WithoutBackDrivenRecordsLoadFrictionIsNotZeroButUnknown) {
  const Identification found = identify(withoutPosture(Posture::kBackDriven), {});
  const Figure& f = found.figures.at("load_friction");
  EXPECT_FALSE(f.identified);
  EXPECT_EQ(f.why, "needs back-driven records");
  EXPECT_EQ(found.figures.correlation.rows(), 8);
  EXPECT_NEAR(found.figures.at("coulomb_friction_Nm").value, 0.5, 0.05);
  EXPECT_THAT(figureComments(found, "wheel 1"),
              HasSubstr("load-dependent friction  not identified"));
  EXPECT_THROW(identify(withoutPosture(Posture::kFree), {}), InputError);
  EXPECT_THROW(identify(withoutPosture(Posture::kBlocked), {}), InputError);
}

// As if somebody had held the output that was to swing freely: what is held out tells.
TEST(Identify, SaysWhenTheModelDoesNotFit) {
  std::vector<Record> records = standRecords();
  for (Record& r : records) {
    if (!r.held_out || r.posture != Posture::kFree) continue;
    for (double& t : r.motor_torque) t *= -0.5;
  }
  const Identification found = identify(records, {});
  EXPECT_FALSE(found.valid());
  EXPECT_THAT(found.complaint(), HasSubstr("'free: swings, held out'"));
}

TEST(Identify, WritesWhatScenariosRead) {
  const Identification found = identify(standRecords(), {});
  Configured configured;
  configured.actuator.coulomb_friction = 0.4;
  configured.actuator.static_friction = 0.6;
  configured.torque_frequency_Hz = 40;
  configured.torque_damping_ratio = 0.7071;
  const std::string text = actuatorYaml(found, configured, "wheel 1");
  const ConfigNode tree = parseYaml(text, "actuator.yaml");
  ConfigReader in(tree);
  const ActuatorParameters p = ActuatorParameters::read(in);
  EXPECT_NEAR(p.reflectedInertia(), 0.1, 0.002);
  EXPECT_NEAR(p.static_friction - p.coulomb_friction, 0.2, 1e-3);
  // The model's drive, set like this, measures the bandwidth that was found.
  EXPECT_NEAR(
      torqueBandwidthFor(p, configured.drive_period, found.figures.at("bandwidth_Hz").value),
      p.torque_bandwidth, 0.01);
  EXPECT_THAT(text, HasSubstr("#   backlash"));
  const std::string scenario =
      scenarioYaml(found, configured, {"wheel 1", "balance.yaml", "wheel", "drive.yaml", true});
  EXPECT_THAT(scenario, HasSubstr("wheel: {include: drive.yaml}"));
  EXPECT_THAT(scenario, HasSubstr("transport_delay_ticks: 3"));
  EXPECT_THAT(scenario, HasSubstr("wheel_shaping: {zero_rad_per_s:"));
  EXPECT_EQ(verdictOf(found.figures.at("rotor_inertia_kgm2"), configured).text, "agrees");
  EXPECT_EQ(verdictOf(found.figures.at("coulomb_friction_Nm"), configured).text, "differs");
  EXPECT_EQ(verdictOf(found.figures.at("backlash_deg"), configured).text, "differs");
}

TEST(TestStand, IsSetThroughItsDriveAndOutlivesAReset) {
  Elastic e;
  EmulatedBench drives(e.emulator, std::make_unique<ElasticRig>(*e.emulator.elastic_rig));
  EmulatedBus bus(drives, 0);
  drives.powerOn();
  SdoExchange exchange(bus, 2, std::chrono::milliseconds(100));
  EXPECT_TRUE(hasStand(exchange));
  EXPECT_TRUE(hasCurrent(exchange));
  setStand(exchange, Posture::kBackDriven);
  drives.drive(1).forceNmt(0x81);
  EXPECT_EQ(drives.drive(1).standOutput(), StandOutput::kTurned);
  EXPECT_EQ(drives.drive(0).standOutput(), StandOutput::kFree) << "each drive its own";
  EXPECT_FALSE(exchange.write(0x2020, 1, 0, 1)) << "a stand does not go away";

  Stand plain({40, 0.7, 0, true});
  SdoExchange other(plain.bus, 2, std::chrono::milliseconds(100));
  EXPECT_FALSE(hasStand(other));
  EXPECT_THROW(setStand(other, Posture::kFree), LostParticipantError);
}

TEST(BenchCheck, TellsWhatIsThereAndWhatDisagreesWithoutTouchingIt) {
  Stand stand({}, ", drive_defaults: {rated_torque_Nm: 10}, imu: {node: 9}");
  const auto reports = checkBench(stand.config, {&stand.bus});
  ASSERT_EQ(reports.size(), 7U);
  EXPECT_TRUE(reports[0].found);
  EXPECT_EQ(reports[0].device, "ballbot emulated drive");
  EXPECT_EQ(reports[0].firmware, "1.0");
  EXPECT_EQ(reports[3].serial, 4);
  EXPECT_DOUBLE_EQ(reports[0].rated_torque_Nm.value(), 20);
  EXPECT_DOUBLE_EQ(reports[0].max_torque_Nm.value(), 30);
  EXPECT_DOUBLE_EQ(reports[0].supply_V.value(), 48);
  EXPECT_TRUE(reports[0].not_given.empty());
  EXPECT_EQ(reports[0].state, "switch on disabled");
  ASSERT_EQ(reports[0].disagreements.size(), 1U);
  EXPECT_EQ(reports[0].disagreements[0], "rated torque [Nm] is 20, configured 10");
  EXPECT_FALSE(reports[6].found) << "no node 9";
  EXPECT_FALSE(stand.drives.drive(0).operational());
}

TEST(BenchCheck, SaysWhatNobodyAnsweredInsteadOfZero) {
  Stand stand({});
  stand.config.sdo_timeout_ms = 20;
  // A node that dies after its first word.
  class DyingBus final : public EmulatedBus {
   public:
    DyingBus(EmulatedBench& bench) : EmulatedBus(bench, 0), bench_(bench) {}
    bool send(const CanFrame& frame) noexcept override {
      if (++asked_ == 8) bench_.drive(0).muteSdo(true);
      return EmulatedBus::send(frame);
    }

   private:
    EmulatedBench& bench_;
    int asked_ = 0;
  } bus(stand.drives);
  const auto reports = checkBench(stand.config, {&bus});
  EXPECT_TRUE(reports[0].found);
  EXPECT_FALSE(reports[0].supply_V) << "not 0 V";
  EXPECT_FALSE(reports[0].max_torque_Nm) << "not 0 Nm";
  EXPECT_THAT(reports[0].not_given,
              ::testing::Contains("6079:00 supply voltage: no answer within 20 ms"));
  EXPECT_THAT(reports[0].disagreements,
              ::testing::Contains(HasSubstr("max torque was not given, the limit asks for 4 Nm")));
}

}  // namespace
}  // namespace ballbot
