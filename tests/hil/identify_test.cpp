#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "core/yaml_file.hpp"
#include "hil/bench_check.hpp"
#include "hil/emulator/emulated_bus.hpp"
#include "hil/emulator/joint_rig.hpp"
#include "hil/identify_drive.hpp"
#include "hil/stepped_runner.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

TEST(TorqueResponse, BandwidthIsWhereTheGainHasFallenByThreeDecibels) {
  for (const double d : {0.3, 0.7071, 1.2}) {
    const TorqueResponse r{2, 200, d, 0.001};
    EXPECT_NEAR(std::abs(r.at(r.bandwidth_Hz())), std::sqrt(0.5), 1e-9);
  }
  const TorqueResponse first{1, 200, 0, 0};
  EXPECT_NEAR(std::abs(first.at(first.bandwidth_Hz())), std::sqrt(0.5), 1e-9);
}

// A first order between a hold and a sampler is b/(z - a) exactly, with a = e^(-w T).
TEST(TorqueResponse, SampledFirstOrderIsTheKnownDigitalFilter) {
  const double period = 0.0025;
  const TorqueResponse r{1, 150, 0, 0};
  const double a = std::exp(-150 * period);
  for (const double f : {1.0, 30.0, 100.0, 190.0}) {
    const std::complex<double> z = std::polar(1.0, kTwoPi * f * period);
    EXPECT_LT(std::abs(r.sampledAt(f, period) - (1 - a) / (z - a)), 0.01) << f;
  }
}

TEST(TorqueResponse, AFitFindsWhatMadeThePoints) {
  const double period = 0.0025;
  const TorqueResponse truth{2, 180, 0.5, 0.0012};
  std::vector<ResponsePoint> points;
  for (double f = 2; f < 150; f *= 1.2) points.push_back({f, truth.sampledAt(f, period)});
  const TorqueResponse found = fitTorqueResponse(points, 2, period);
  EXPECT_NEAR(found.natural_frequency, 180, 1e-3);
  EXPECT_NEAR(found.damping_ratio, 0.5, 1e-5);
  EXPECT_NEAR(found.delay, 0.0012, 1e-7);
  EXPECT_LT(found.residual, 1e-6);
  EXPECT_THROW(fitTorqueResponse({{1, 1.0}}, 2, period), NumericalError);
}

/// A bench with joints on a blocked test stand, known exactly.
struct Stand {
  explicit Stand(const JointRigOptions& rig, const std::string& extra = "")
      : tree(parseYaml(
            "{stepped: true, buses: [{address: none}], drives: [{node: 1}, {node: 2}, "
            "{node: 3}, {node: 4}, {node: 5}, {node: 6}], emulator: {buses: [{link: a}]}" +
                extra + "}",
            "stand")),
        config(forIdentification(readBenchConfig(tree))),
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
    const Identification found = identifyDrive(stand.runner, plan);
    const TorqueResponse truth{2, kTwoPi * rig.bandwidth_Hz, rig.damping_ratio, rig.delay_s};
    EXPECT_NEAR(found.second.bandwidth_Hz(), truth.bandwidth_Hz(), 0.05 * truth.bandwidth_Hz());
    EXPECT_NEAR(found.second.damping_ratio, rig.damping_ratio, 0.05);
    EXPECT_NEAR(found.second.delay, rig.delay_s, 3e-4);
    EXPECT_LT(found.second.residual, 0.02);
    EXPECT_GT(found.first.residual, found.second.residual) << "a second order fits better";
    EXPECT_LE(found.largest_torque, plan.amplitude_Nm + 1e-9);
    EXPECT_FALSE(stand.drives.anyEnergized());
    // The answer lies within its own error bars, widened for the quantisation they leave out.
    EXPECT_NEAR(found.second.natural_frequency, kTwoPi * rig.bandwidth_Hz,
                10 * found.second.natural_frequency_sigma + 0.01 * kTwoPi * rig.bandwidth_Hz);
  }
}

TEST(IdentifyDrive, KeepsToTheLimits) {
  Stand stand({40, 0.7, 0, true});
  ExcitationPlan plan;
  plan.amplitude_Nm = 3;
  plan.bias_Nm = 2;
  try {
    identifyDrive(stand.runner, plan);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("3 Nm around 2 Nm exceed the limit of wheel 1, 4 Nm"));
  }
  plan = {};
  plan.high_Hz = 200;
  EXPECT_THROW(identifyDrive(stand.runner, plan), InputError);
}

TEST(IdentifyDrive, LeavesTheDrivesOffWhenInterrupted) {
  Stand stand({40, 0.7, 0, true});
  const std::atomic<bool> stop{true};
  EXPECT_THROW(identifyDrive(stand.runner, {}, &stop), InterruptedError);
  EXPECT_FALSE(stand.drives.anyEnergized());
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
