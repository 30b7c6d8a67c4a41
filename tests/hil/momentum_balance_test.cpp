// Records whose every value is known in closed form: the estimators against algebra, without a rig.
#include <cmath>
#include <functional>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "hil/identify/balance_fit.hpp"
#include "hil/identify/spectrum.hpp"

namespace ballbot {
namespace {

constexpr double kPeriod = 0.0025;

BalanceVector aDrive() {
  return (BalanceVector() << 0.1, 350, 0.2, 0.3, 0.5, 0.08, 0.0017).finished();
}

struct Motion {
  double motor_amplitude, motor_Hz, second_Hz, joint_amplitude, joint_Hz;
};

/// The rotor swings by two sines, the output by one; the motor's mean torque follows from them by
/// the integral over each period, in fine steps.
Record recordOf(Posture posture, const Motion& m, const BalanceVector& p, double seconds,
                const std::function<double()>& noise) {
  const double w1 = kTwoPi * m.motor_Hz, w2 = kTwoPi * m.second_Hz, wj = kTwoPi * m.joint_Hz;
  const double a = m.motor_amplitude, b = 0.4 * a, c = m.joint_amplitude;
  const auto torqueAt = [&](double t) {
    const double angle = a * std::sin(w1 * t) + b * std::sin(w2 * t) + c * std::sin(wj * t);
    const double rate = a * w1 * std::cos(w1 * t) + b * w2 * std::cos(w2 * t);
    const double velocity = rate + c * wj * std::cos(wj * t);
    const double acceleration = -a * w1 * w1 * std::sin(w1 * t) - b * w2 * w2 * std::sin(w2 * t) -
                                c * wj * wj * std::sin(wj * t);
    const BalanceTerms terms =
        balanceTerms(p, velocity > 0 ? 1 : -1, angle - c * std::sin(wj * t), rate, velocity);
    return p[kRotorInertia] * acceleration + p[kViscous] * velocity + terms.spring +
           terms.dry_friction;
  };
  Record r;
  r.posture = posture;
  r.period = kPeriod;
  const int count = static_cast<int>(seconds / kPeriod), fine = 16;
  for (int n = 0; n < count; ++n) {
    const double t = n * kPeriod;
    double mean = 0;
    for (int i = 0; i < fine; ++i) {
      mean += torqueAt(t - kPeriod * (i + 0.5) / fine) / fine;
    }
    r.sent.push_back(0);
    r.joint_torque.push_back(0);
    r.motor_torque.push_back(mean + noise());
    r.joint_angle.push_back(c * std::sin(wj * t) + 0.7);
    r.motor_angle.push_back(a * std::sin(w1 * t) + b * std::sin(w2 * t) + c * std::sin(wj * t) +
                            0.7);
  }
  return r;
}

std::vector<Record> allPostures(const BalanceVector& p, const std::function<double()>& noise) {
  return {recordOf(Posture::kBlocked, {0.008, 7, 13, 0, 0}, p, 6, noise),
          recordOf(Posture::kFree, {0.001, 1.3, 2.1, 0.8, 0.4}, p, 8, noise),
          recordOf(Posture::kBackDriven, {0.008, 0.31, 0.83, 0.6, 0.45}, p, 12, noise)};
}

BalanceFit fitted(const std::vector<Record>& records, const BalanceFit* start = nullptr) {
  std::vector<MomentumBalance> balances;
  for (const Record& r : records) {
    balances.emplace_back(r, 0.15, r.posture == Posture::kBlocked ? 2 : 7);
  }
  return fitBalance(balances, start);
}

TEST(MomentumBalance, FindsWhatMadeTheRecords) {
  const BalanceVector truth = aDrive();
  const BalanceFit fit = fitted(allPostures(truth, [] { return 0.0; }));
  for (int i = 0; i < kBalanceCount; ++i) {
    EXPECT_NEAR(fit.value[i], truth[i], 2e-3 * std::abs(truth[i])) << i;
  }
  for (const double zero : fit.zeros) EXPECT_NEAR(zero, 0, 1e-6);
}

TEST(MomentumBalance, FindsZeroWhereThereIsNothing) {
  BalanceVector truth = aDrive();
  truth[kBacklash] = truth[kLoadFriction] = truth[kCoulomb] = 0;
  const BalanceFit fit = fitted(allPostures(truth, [] { return 0.0; }));
  EXPECT_NEAR(fit.value[kBacklash], 0, 1e-6);
  EXPECT_NEAR(fit.value[kLoadFriction], 0, 1e-4);
  EXPECT_NEAR(fit.value[kCoulomb], 0, 1e-3);
}

// Slopes of the model against differences of it, on both sides of the flanks.
TEST(MomentumBalance, SlopesAreThoseOfTheModel) {
  for (const double gap : {0.0017, -0.0017}) {
    for (const double deflection : {0.004, 0.0003, -0.004}) {
      BalanceVector p = aDrive();
      p[kBacklash] = gap;
      const auto sum = [&](const BalanceVector& at, double d) {
        const BalanceTerms t = balanceTerms(at, -1, d, 0.3, -0.8);
        return t.spring + t.dry_friction + at[kViscous] * -0.8;
      };
      const BalanceTerms t = balanceTerms(p, -1, deflection, 0.3, -0.8);
      for (int i = kStiffness; i < kBalanceCount; ++i) {
        const double step = 1e-6 * std::max(1e-3, std::abs(p[i]));
        BalanceVector up = p, down = p;
        up[i] += step;
        down[i] -= step;
        EXPECT_NEAR(t.slope[i], (sum(up, deflection) - sum(down, deflection)) / (2 * step),
                    1e-4 * std::max(1.0, std::abs(t.slope[i])))
            << i << " at " << deflection;
      }
      EXPECT_NEAR(t.zero_slope, (sum(p, deflection - 1e-8) - sum(p, deflection + 1e-8)) / 2e-8,
                  1e-3 * 350);
    }
  }
}

// Noise that remembers: with a covariance for white noise the errors would be 1.7 sigma.
TEST(MomentumBalance, SigmaIsHonestForNoiseThatRemembers) {
  std::mt19937 engine(7);
  std::normal_distribution<double> normal;
  double state = 0;
  const auto noise = [&] { return state = 0.5 * state + 0.1 * normal(engine); };
  const BalanceVector truth = aDrive();
  const std::vector<Record> clean = allPostures(truth, [] { return 0.0; });
  const BalanceFit start = fitted(clean);
  double square = 0;
  int within = 0, all = 0;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Record> noisy = clean;
    for (Record& r : noisy) {
      for (double& t : r.motor_torque) t += noise();
    }
    const BalanceFit fit = fitted(noisy, &start);
    for (int i = 0; i < kBalanceCount; ++i) {
      const double z = (fit.value[i] - truth[i]) / std::sqrt(fit.covariance(i, i));
      square += z * z;
      within += std::abs(z) < 2 ? 1 : 0;
      ++all;
    }
  }
  EXPECT_NEAR(std::sqrt(square / all), 1, 0.25);
  EXPECT_GT(within, 0.88 * all);
}

TEST(MomentumBalance, SaysWhatIsMissing) {
  BalanceVector truth = aDrive();
  std::vector<Record> records = allPostures(truth, [] { return 0.0; });
  records[1] = recordOf(Posture::kFree, {0.001, 1.3, 2.1, 0.01, 0.4}, truth, 8, [] { return 0.0; });
  records[1].name = "swings";
  try {
    fitted(records);
    FAIL();
  } catch (const NumericalError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("record 'swings' (free) has 0 samples"));
  }
}

TEST(Record, ABlockedOutputGivesWayOnlyAsTheTorquePushes) {
  std::mt19937 engine(3);
  std::normal_distribution<double> noise(0, 1e-4);
  Record r;
  r.posture = Posture::kBlocked;
  for (int n = 0; n < 4000; ++n) {
    const double spring = 0.01 * std::sin(0.05 * n);
    r.joint_angle.push_back(0.5 + 0.1 * spring + noise(engine));
    r.motor_angle.push_back(0.5 + 1.1 * spring);
  }
  const std::vector<double> deflection = r.deflection();
  for (std::size_t n = 0; n < deflection.size(); ++n) {
    EXPECT_NEAR(deflection[n], 0.01 * std::sin(0.05 * static_cast<double>(n)), 2e-5) << n;
  }
}

TEST(Spectrum, IsTheSignalBetweenItsSamplesToo) {
  std::vector<double> period(80);
  const auto signal = [](double t) {
    return 0.3 + std::cos(kTwoPi * 3 * t) - 2 * std::sin(kTwoPi * 17 * t);
  };
  for (std::size_t n = 0; n < period.size(); ++n) period[n] = signal(static_cast<double>(n) / 80);
  const Spectrum s = spectrumOf(period);
  EXPECT_EQ(excitedLines(s), (std::vector<int>{3, 17}));
  EXPECT_LT(std::abs(lineOf(period, 17) - Complex(0, 1)), 1e-12);
  const std::vector<double> fine = sampledFinely(s, 333),
                            slope = sampledFinely(derivativeOf(s, 2), 333);
  for (std::size_t n = 0; n < fine.size(); ++n) {
    const double t = static_cast<double>(n) / 333;
    EXPECT_NEAR(fine[n], signal(t), 1e-9);
    EXPECT_NEAR(slope[n], kPi * (-3 * std::sin(kTwoPi * 3 * t) - 34 * std::cos(kTwoPi * 17 * t)),
                1e-8);
  }
}

}  // namespace
}  // namespace ballbot
