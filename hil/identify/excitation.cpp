#include "hil/identify/excitation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

// Where k and J w^2 are of one size and the rotor is fast while the spring gives little way. Above,
// what happens between two samples counts more and more.
constexpr double kSlowLow_Hz = 5, kSlowHigh_Hz = 16;
constexpr int kSlowLines = 7;
constexpr double kCorner_Hz = 20;
constexpr double kScatter = 0.3819660113;  // turns; no multiple of its squares comes near another
constexpr double kFree_s = 8, kBackDriven_s = 12, kHeldOutShare = 0.5, kSettle_s = 1;
/// Two swings: share of the amplitude, frequency. Of the free output, as angles; and of the torque
/// while the output is turned.
struct Swing {
  double share, frequency_Hz;
};
constexpr Swing kFreeFit[] = {{0.68, 0.70}, {0.32, 1.90}},
                kFreeHeldOut[] = {{0.6, 0.85}, {0.4, 1.6}};
constexpr Swing kTurnFit[] = {{0.6, 0.31}, {0.4, 0.83}},
                kTurnHeldOut[] = {{0.7, 0.37}, {0.3, 0.61}};

Excitation periodic(const char* name, std::vector<double> shape, double amplitude, int periods,
                    bool held_out) {
  Excitation e;
  e.name = name;
  e.held_out = held_out;
  e.repeats = e.settle = static_cast<int>(shape.size());
  for (int p = 0; p < periods; ++p) {
    for (const double x : shape) e.value.push_back(amplitude * x);
  }
  return e;
}

/// From rest at zero; `angle`: always on one side of it, the whole swing `size` wide.
Excitation swings(const char* name, const Swing (&two)[2], double size, double seconds,
                  double period, bool angle, bool held_out) {
  Excitation e;
  e.name = name;
  e.held_out = held_out;
  e.is_angle = angle;
  e.settle = static_cast<int>(kSettle_s / period);
  const int count = e.settle + static_cast<int>(seconds / period);
  for (int n = 0; n < count; ++n) {
    double sum = 0;
    for (const Swing& s : two) {
      const double phase = kTwoPi * s.frequency_Hz * n * period;
      sum += s.share * (angle ? 0.5 * (1 - std::cos(phase)) : std::sin(phase));
    }
    e.value.push_back(size * sum);
  }
  return e;
}

std::vector<Excitation> blocked(const ExcitationPlan& plan, double period) {
  const int length = static_cast<int>(std::lround(plan.record_s / period));
  const auto wide = linesBetween(plan.low_Hz, plan.high_Hz, plan.lines, plan.record_s);
  const auto slow = linesBetween(std::min(kSlowLow_Hz, plan.high_Hz),
                                 std::min(kSlowHigh_Hz, plan.high_Hz), kSlowLines, plan.record_s);
  const double a = plan.amplitude_Nm, corner = kCorner_Hz * plan.record_s;
  const auto shape = [&](const std::vector<int>& lines, Phases phases) {
    return multisine(lines, length, corner, phases);
  };
  const int n = plan.records;
  std::vector<Excitation> out;
  out.push_back(periodic("response", shape(wide, Phases::kSchroeder), a, n, false));
  out.push_back(periodic("response, mirrored", shape(wide, Phases::kMirrored), a, n, false));
  out.push_back(periodic("response, held out", shape(wide, Phases::kScattered), a, 2, true));
  out.push_back(periodic("spring", shape(slow, Phases::kSchroeder), a, n + 1, false));
  out.push_back(periodic("spring, held out", shape(slow, Phases::kMirrored), a, 2, true));
  out[3].needs_current = out[4].needs_current = true;
  return out;
}

void requireAllowed(const ExcitationPlan& plan, const DriveConfig& drive,
                    const SafetyConfig& safety, double period) {
  if (plan.amplitude_Nm > drive.limits.torque) {
    throw InputError(fmt::format("identify: {} Nm exceed the limit of {}, {} Nm", plan.amplitude_Nm,
                                 drive.name, drive.limits.torque));
  }
  if (plan.high_Hz >= 0.5 / period || plan.low_Hz <= 0 || plan.low_Hz >= plan.high_Hz) {
    throw InputError(
        fmt::format("identify: {} to {} Hz; must lie between 0 and half the bus rate, "
                    "{} Hz",
                    plan.low_Hz, plan.high_Hz, 0.5 / period));
  }
  const double ramp_s = safety.ramp_cycles * period, settle_s = std::min(kSettle_s, plan.record_s);
  if (ramp_s > settle_s) {
    throw InputError(fmt::format(
        "identify: torque grows over ramp_ms, {:.3g} s, longer than the {:.3g} s in which a record "
        "settles; make ramp_ms shorter or --record-s longer",
        ramp_s, settle_s));
  }
  if (plan.records < 2) throw InputError("identify: at least two records, the first one settles");
}

}  // namespace

std::vector<int> linesBetween(double low_Hz, double high_Hz, int count, double record_s) {
  std::vector<int> lines;
  for (int i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / (count - 1) : 0;
    const double f = low_Hz * std::pow(high_Hz / low_Hz, share);
    const int k = std::max(1, static_cast<int>(std::lround(f * record_s)));
    if (lines.empty() || k > lines.back()) lines.push_back(k);
  }
  return lines;
}

std::vector<double> multisine(const std::vector<int>& lines, int length, double corner,
                              Phases phases) {
  std::vector<double> signal(static_cast<std::size_t>(length));
  const auto count = static_cast<double>(lines.size());
  double peak = 0;
  for (int n = 0; n < length; ++n) {
    double sum = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto k = static_cast<double>(i);
      const double schroeder = -kPi * k * (k + 1) / count;
      const double phase = phases == Phases::kSchroeder  ? schroeder
                           : phases == Phases::kMirrored ? -schroeder
                                                         : kTwoPi * kScatter * k * k;
      sum += std::cos(kTwoPi * lines[i] * n / length + phase) / std::hypot(1, lines[i] / corner);
    }
    signal[static_cast<std::size_t>(n)] = sum;
    peak = std::max(peak, std::abs(sum));
  }
  for (double& x : signal) x /= peak;
  return signal;
}

std::vector<Excitation> excitationsFor(Posture posture, const ExcitationPlan& plan,
                                       const BenchConfig& bench) {
  const double period = bench.cycleSeconds();
  requireAllowed(plan, bench.drives.at(static_cast<std::size_t>(plan.drive)), bench.safety, period);
  const double part = kHeldOutShare, a = plan.amplitude_Nm, travel = plan.travel_rad;
  switch (posture) {
    case Posture::kBlocked:
      return blocked(plan, period);
    case Posture::kFree:
      return {swings("swings", kFreeFit, travel, kFree_s, period, true, false),
              swings("swings, held out", kFreeHeldOut, travel, part * kFree_s, period, true, true)};
    case Posture::kBackDriven:
      return {
          swings("turned", kTurnFit, a, kBackDriven_s, period, false, false),
          swings("turned, held out", kTurnHeldOut, a, part * kBackDriven_s, period, false, true)};
  }
  return {};
}

double secondsOf(Posture posture, const ExcitationPlan& plan, const BenchConfig& bench) {
  std::size_t samples = 0;
  for (const Excitation& e : excitationsFor(posture, plan, bench)) samples += e.value.size();
  return static_cast<double>(samples) * bench.cycleSeconds();
}

}  // namespace ballbot
