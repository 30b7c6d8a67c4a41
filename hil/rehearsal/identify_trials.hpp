#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "hil/emulator/elastic_rig.hpp"
#include "hil/emulator/emulator_config.hpp"
#include "hil/identify/identify.hpp"
#include "hil/identify/take_records.hpp"

namespace ballbot {

/// What a drive on the emulated stand really is: the figures of `identify` by their keys.
/// The bandwidth is measured on a joint of its own, without dry friction and backlash, by sines.
double trueFigure(const ElasticJointParameters& joint, const std::string& key);

/// Frequency at which the encoders of a blocked joint show -3 dB of a sinusoidal torque command,
/// found by sines alone [Hz].
double sweptBandwidth_Hz(ElasticJointParameters joint);

/// Bench and emulated stand in one process, stepped, and all records of one drive with them.
/// @param bench     as the master has it, without the motor's current
/// @param emulator  with an elastic rig
std::vector<Record> recordsOnStand(const BenchConfig& bench, const EmulatorConfig& emulator,
                                   const ExcitationPlan& plan, bool back_driven = true,
                                   const std::atomic<bool>* stop = nullptr);

/// One figure over many seeds of the noise. z is its error over its sigma.
struct FigureTrials {
  std::string key, name, unit;
  double truth = 0;
  std::vector<double> values, sigmas;

  double mean() const;
  double rmsZ() const;
  int withinTwoSigma() const;
  /// Of all trials, those within 5 % or two sigma.
  int good() const;
};

struct IdentifyTrials {
  std::vector<FigureTrials> figures;
  int seeds = 0, invalid = 0;  ///< held-out records did not fit

  double rmsZ() const;  ///< of all figures
  double percentWithinTwoSigma() const;
  double percentGood() const;
  /// All records fit, every figure of every seed is good but for those that two sigma leave out,
  /// 90 to 99 % lie within two sigma, and the rms of z is 0.8 to 1.25.
  bool honest() const;
};

/// Identifies a drive of the emulated stand with noise seeds 1 to `seeds`: are the figures right,
/// and do their sigmas tell the truth?
/// @throw InputError if the emulator has no elastic rig
IdentifyTrials tryIdentification(const BenchConfig& bench, EmulatorConfig emulator,
                                 const ExcitationPlan& plan, const IdentifyOptions& options,
                                 int seeds, const std::atomic<bool>* stop = nullptr);

}  // namespace ballbot
