// Is the covariance of the filter that estimates the ball's spin true, whether the floor holds the
// ball or not? Monte Carlo over seeds; label sim.
#include <cmath>
#include <cstdio>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/random.hpp"
#include "tests/estimator/support/filter_run.hpp"

namespace ballbot::test {
namespace {

using SpinTangent = BasicTangentVector<kSpinTangentDim>;

/// Means of normalised squares, where 1 is right, less is cautious and more is too sure.
struct Ratios {
  double nees = 0;      ///< of all 17
  double bias_yaw = 0;  ///< of the gyroscope's bias about the vertical and yaw
  double spin = 0;
  double nis = 0;
  double bias_sigma = 0;  ///< of the gyroscope's about the vertical [rad/s]
  int samples = 0;

  void add(const SpinTwoStateFilter& filter, const Truth& truth) {
    const SpinTangent e = truthAsFilterState(truth).minus<kSpinTangentDim>(filter.state());
    const auto P = filter.covariance();
    Eigen::Matrix<double, 2, kSpinTangentDim> pick = decltype(pick)::Zero();
    pick.block<1, 3>(0, kTanAttitude) = filter.state().R_WB.row(2);
    pick.block<1, 3>(1, kTanGyroBias) = filter.state().R_WB.row(2);
    const Eigen::Vector2d picked = pick * e;
    const Eigen::Matrix2d P_picked = pick * P * pick.transpose();
    ++samples;
    nees += (e.dot(filter.information() * e) / kSpinTangentDim - nees) / samples;
    bias_yaw += (picked.dot(Eigen::Vector2d(P_picked.lu().solve(picked))) / 2 - bias_yaw) / samples;
    spin += (e[kTanSpin] * e[kTanSpin] / P(kTanSpin, kTanSpin) - spin) / samples;
    nis += (filter.nis() / filter.nisDegrees() - nis) / samples;
    bias_sigma += (std::sqrt(P_picked(1, 1)) - bias_sigma) / samples;
  }
};

/// Over `runs` seeds of 15 s of lively motion: while the floor holds the ball, while it comes to
/// spin or to rest, and while it spins alike.
struct Phases {
  Ratios sticking, changing, spinning;
  std::int64_t rejected = 0;
};

template <typename Spins>
Phases monteCarlo(int runs, const Spins& spinsOf,
                  const TwoStateSettings& settings = matchedSettings()) {
  Phases phases;
  for (int seed = 1; seed <= runs; ++seed) {
    SpinFilterRun run;
    run.seed = static_cast<std::uint64_t>(seed);
    run.seconds = 15.5;
    run.noise = whiteNoise();
    run.settings = settings;
    run.script.spins = spinsOf(run.seed);
    double before = 0;
    run.observe = [&](const SpinTwoStateFilter& filter, const Truth& truth) {
      const bool alike = std::abs(truth.mean_spin - before) < 1e-12;
      before = truth.mean_spin;
      if (truth.t_s < 1.5) return;
      Ratios& phase = std::abs(truth.mean_spin) < 0.025 ? phases.sticking
                      : alike                           ? phases.spinning
                                                        : phases.changing;
      phase.add(filter, truth);
    };
    RejectionCounts counts;
    play(run, &counts);
    phases.rejected += counts.total();
  }
  for (const auto& [name, r] : {std::pair("sticking", phases.sticking),
                                {"changing", phases.changing},
                                {"spinning", phases.spinning}}) {
    if (r.samples == 0) continue;
    std::printf("%s: nees %.2f, yaw and bias %.2f, spin %.2f, nis %.3f, bias sigma %.2e, n %d\n",
                name, r.nees * kSpinTangentDim, r.bias_yaw, r.spin, r.nis * 4, r.bias_sigma,
                r.samples);
  }
  std::printf("rejected %ld\n", static_cast<long>(phases.rejected));
  return phases;
}

std::vector<SpinPulse> none(std::uint64_t) { return {}; }

/// What friction lets creep under a torque that changes ten times a second: 0.01 rad/s.
std::vector<SpinPulse> creeping(std::uint64_t seed) {
  const RandomStream random(seed, "creep");
  std::vector<SpinPulse> pulses;
  for (int i = 0; i < 150; ++i) {
    const double from = 0.5 + 0.1 * i;
    const double rate = 0.01 * random.normals(static_cast<std::uint64_t>(i))[0];
    pulses.push_back({from, from + 0.1, std::clamp(rate, -0.02, 0.02), 0.02});
  }
  return pulses;
}

/// Every two seconds the floor lets go for half a second to one and a half, at up to 2 rad/s, which
/// the ball takes 20 to 80 ms to reach.
std::vector<SpinPulse> spells(std::uint64_t seed) {
  const RandomStream random(seed, "spells");
  std::vector<SpinPulse> pulses;
  for (int i = 0; i < 7; ++i) {
    const auto u = random.uniforms(static_cast<std::uint64_t>(i));
    const double from = 1.5 + 2.0 * i;
    const double rate = (u[0] < 0.5 ? -1 : 1) * (0.1 + 1.9 * u[1]);
    pulses.push_back({from, from + 0.5 + u[2], rate, 0.02 + 0.06 * u[3]});
  }
  return pulses;
}

/// Three standard deviations of the mean over 30 runs; yaw and bias are two numbers of a run.
void expectTrue(const Ratios& r) {
  EXPECT_GT(r.nees, 14.0 / kSpinTangentDim);
  EXPECT_LT(r.nees, 19.0 / kSpinTangentDim);
  EXPECT_GT(r.bias_yaw, 0.5);
  EXPECT_LT(r.bias_yaw, 1.5);
}

TEST(SpinConsistency, HoldsWhileTheFloorHoldsTheBall) {
  const Phases p = monteCarlo(30, none);
  expectTrue(p.sticking);
  EXPECT_NEAR(4 * p.sticking.nis, 4, 0.1);
  // Of half a million increments one is beyond five standard deviations by chance.
  EXPECT_LE(p.rejected, 4);
}

TEST(SpinConsistency, HoldsWhileTheBallCreeps) {
  const Phases p = monteCarlo(30, creeping);
  expectTrue(p.sticking);
  EXPECT_NEAR(4 * p.sticking.nis, 4, 0.1);
  EXPECT_LE(p.rejected, 4);
}

TEST(SpinConsistency, HoldsThroughSpellsOfSpinning) {
  const Phases p = monteCarlo(30, spells);
  expectTrue(p.sticking);
  expectTrue(p.spinning);
  EXPECT_GT(p.spinning.spin, 0.5);
  EXPECT_LT(p.spinning.spin, 1.5);
  // Cautious: a spin is expected to change by 0.1 rad/s in every interval, and mostly does not.
  EXPECT_GT(4 * p.spinning.nis, 3);
  EXPECT_LT(4 * p.spinning.nis, 4.1);
  EXPECT_LE(p.rejected, 4);
}

TEST(SpinConsistency, FailsForAFilterThatTakesASpinForSteady) {
  TwoStateSettings settings = matchedSettings();
  settings.spin.acceleration = 1;
  settings.spin.jump_sigma = settings.gate.wheel_gate_sigma = settings.gate.wheel_slip_sigma = 1e6;
  settings.gate.chi_square_limit = 1e9;
  EXPECT_GT(monteCarlo(5, spells, settings).spinning.nees, 1.5);
}

TEST(SpinConsistency, AtRestForTenMinutesYawIsAsUncertainAsItSays) {
  // A ball that may creep shows the gyroscope's bias less well than one that cannot.
  SpinFilterRun run;
  run.script = standingStill();
  run.noise = whiteNoise();
  run.seconds = 600;
  double error2 = 0, sigma = 0;
  for (run.seed = 1; run.seed <= 3; ++run.seed) {
    run.observe = [&](const SpinTwoStateFilter& f, const Truth&) {
      if (toNs(f.stateTime()) % 1'000'000'000 == 0) sigma = f.estimate(f.stateTime()).sigma[4];
    };
    const RunErrors e = play(run);
    error2 += std::pow(e.yaw_end_deg * kRadPerDeg / sigma, 2);
  }
  std::printf("yaw after ten minutes: sigma %.2f degrees\n", sigma / kRadPerDeg);
  EXPECT_LT(error2, 11.3);  // chi-square (3), one percent
  EXPECT_GT(sigma, 2.8 * kRadPerDeg);
  EXPECT_LT(sigma, 9.7 * kRadPerDeg);  // that of the bias' wandering alone, never seen
}

}  // namespace
}  // namespace ballbot::test
