#include "hil/identify_drive.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

/// Whole periods per record, evenly spread in the logarithm, none twice.
std::vector<int> linesOf(const ExcitationPlan& plan) {
  std::vector<int> lines;
  for (int i = 0; i < plan.lines; ++i) {
    const double share = plan.lines > 1 ? static_cast<double>(i) / (plan.lines - 1) : 0;
    const double f = plan.low_Hz * std::pow(plan.high_Hz / plan.low_Hz, share);
    const int k = std::max(1, static_cast<int>(std::lround(f * plan.record_s)));
    if (lines.empty() || k > lines.back()) lines.push_back(k);
  }
  return lines;
}

/// One record of the sum of sines with unit peak.
std::vector<double> multisine(const std::vector<int>& lines, int length) {
  std::vector<double> signal(static_cast<std::size_t>(length));
  const auto count = static_cast<double>(lines.size());
  double peak = 0;
  for (int n = 0; n < length; ++n) {
    double sum = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto k = static_cast<double>(i);
      const double phase = -kPi * k * (k + 1) / count;  // Schroeder
      sum += std::cos(kTwoPi * lines[i] * n / length + phase);
    }
    signal[static_cast<std::size_t>(n)] = sum;
    peak = std::max(peak, std::abs(sum));
  }
  for (double& x : signal) x /= peak;
  return signal;
}

std::complex<double> line(const std::vector<double>& signal, int k) {
  std::complex<double> sum = 0;
  const auto n = static_cast<double>(signal.size());
  for (std::size_t i = 0; i < signal.size(); ++i) {
    sum += signal[i] * std::polar(1.0, -kTwoPi * k * static_cast<double>(i) / n);
  }
  return sum;
}

void requireAllowed(const ExcitationPlan& plan, const DriveConfig& drive, double period) {
  if (plan.amplitude_Nm + std::abs(plan.bias_Nm) > drive.limits.torque) {
    throw InputError(fmt::format("identify: {} Nm around {} Nm exceed the limit of {}, {} Nm",
                                 plan.amplitude_Nm, plan.bias_Nm, drive.name, drive.limits.torque));
  }
  if (plan.high_Hz >= 0.5 / period || plan.low_Hz <= 0 || plan.low_Hz >= plan.high_Hz) {
    throw InputError(
        fmt::format("identify: {} to {} Hz; must lie between 0 and half the bus rate, "
                    "{} Hz",
                    plan.low_Hz, plan.high_Hz, 0.5 / period));
  }
}

}  // namespace

BenchConfig forIdentification(BenchConfig config) {
  for (const DriveConfig& drive : config.drives) {
    config.safety.torque_mismatch =
        std::max(config.safety.torque_mismatch, 3 * drive.limits.torque);
  }
  return config;
}

Identification identifyDrive(BenchRunner& runner, const ExcitationPlan& plan,
                             const std::atomic<bool>* stop) {
  const BenchConfig& config = runner.bench().config();
  const DriveConfig& drive = config.drives.at(static_cast<std::size_t>(plan.drive));
  const double period = config.cycleSeconds();
  requireAllowed(plan, drive, period);
  const int length = static_cast<int>(std::lround(plan.record_s / period));
  const std::vector<int> lines = linesOf(plan);
  const std::vector<double> shape = multisine(lines, length);

  Identification out;
  std::vector<double> input(shape.size()), output(shape.size());
  const auto d = static_cast<std::size_t>(plan.drive);
  BenchCommand command;
  runner.engage();
  std::int64_t cycle = 0;
  const BenchSample* sample = &runner.sample(0);
  const int ramp = config.safety.ramp_cycles;
  const auto total = ramp + static_cast<std::int64_t>(length) * plan.records;
  for (; cycle < total; ++cycle) {
    if (stop != nullptr && stop->load()) {
      runner.release();
      throw InterruptedError("identify: interrupted; the drives are off");
    }
    const auto n = static_cast<std::size_t>((cycle + length - ramp % length) % length);
    command.torque[d] = plan.bias_Nm + plan.amplitude_Nm * shape[n];
    runner.command(cycle, command);
    // Records after the first are averaged; what was sent counts, not what was asked for.
    if (cycle >= ramp + length) {
      input[n] += drive.scaling.torque(drive.scaling.torqueCounts(command.torque[d]));
      output[n] += sample->joint_torque[d];
    }
    out.largest_torque = std::max(out.largest_torque, std::abs(command.torque[d]));
    sample = &runner.sample(cycle + 1);
  }
  runner.release();
  runner.requireGoodEnd();
  for (const int k : lines) {
    out.points.push_back({k / plan.record_s, line(output, k) / line(input, k)});
  }
  out.first = fitTorqueResponse(out.points, 1, period);
  out.second = fitTorqueResponse(out.points, 2, period);
  return out;
}

}  // namespace ballbot
