#include "hil/rehearsal/identify_trials.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "hil/emulator/emulated_bus.hpp"
#include "hil/identify/stand.hpp"
#include "hil/stepped_runner.hpp"

namespace ballbot {
namespace {

constexpr std::chrono::milliseconds kPatience{100};
// Of the sweep: small enough that no motor saturates, long enough that nothing of the start is
// left.
constexpr double kSweepTorque = 0.1, kSweepSettle_s = 1, kSweep_s = 1;
constexpr double kSweepLow_Hz = 5, kSweepHigh_Hz = 300;

/// Gain of the torque shown over the torque asked for, at one frequency.
double gainAt(const ElasticJointParameters& p, double frequency_Hz) {
  ElasticJoint joint(p);
  joint.setOutput(StandOutput::kBlocked);
  constexpr double h = ElasticJoint::kTick;
  const double w = kTwoPi * frequency_Hz;
  const int settle = static_cast<int>(kSweepSettle_s / h);
  const int count =
      static_cast<int>(std::lround(std::ceil(kSweep_s * frequency_Hz) / (frequency_Hz * h)));
  double in_phase = 0, quadrature = 0;
  for (int n = 0; n < settle + count; ++n) {
    DriveCommand command;
    command.torque = kSweepTorque * std::sin(w * n * h);
    if (n >= settle) {
      const double shown = p.actuator.spring_stiffness * (joint.motorAngle() - joint.jointAngle());
      in_phase += shown * std::sin(w * n * h) * 2 / count;
      quadrature += shown * std::cos(w * n * h) * 2 / count;
    }
    joint.advance(h, command);
  }
  const double held = std::sin(0.5 * w * h) / (0.5 * w * h);  // a command is held for a tick
  return std::hypot(in_phase, quadrature) / (kSweepTorque * held);
}

double rootMeanSquareOf(const std::vector<FigureTrials>& figures) {
  double sum = 0;
  for (const FigureTrials& f : figures) sum += f.rmsZ() * f.rmsZ();
  return figures.empty() ? 0 : std::sqrt(sum / static_cast<double>(figures.size()));
}

double percentOf(const std::vector<FigureTrials>& figures,
                 const std::function<int(const FigureTrials&)>& count) {
  int hits = 0, all = 0;
  for (const FigureTrials& f : figures) {
    hits += count(f);
    all += static_cast<int>(f.values.size());
  }
  return all == 0 ? 0 : 100.0 * hits / all;
}

}  // namespace

double sweptBandwidth_Hz(ElasticJointParameters p) {
  p.actuator.coulomb_friction = p.actuator.static_friction = p.load_friction = p.backlash = 0;
  double low = kSweepLow_Hz, high = kSweepHigh_Hz;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (gainAt(p, middle) < std::sqrt(0.5) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

double trueFigure(const ElasticJointParameters& p, const std::string& key) {
  const ActuatorParameters& a = p.actuator;
  if (key == "stiffness_Nm_per_rad") return a.spring_stiffness;
  if (key == "rotor_inertia_kgm2") return a.gear_ratio * a.gear_ratio * a.motor_inertia;
  if (key == "viscous_friction_Nms_per_rad") return a.viscous_friction;
  if (key == "coulomb_friction_Nm") return a.coulomb_friction;
  if (key == "load_friction") return p.load_friction;
  if (key == "backlash_deg") return p.backlash * kDegPerRad;
  if (key == "spring_damping_Nms_per_rad") return a.spring_damping;
  if (key == "delay_ms") return 1e3 * p.command_delay;
  if (key == "bandwidth_Hz") return sweptBandwidth_Hz(p);
  throw InputError("identify: the stand has no figure " + key);
}

std::vector<Record> recordsOnStand(const BenchConfig& bench, const EmulatorConfig& emulator,
                                   const ExcitationPlan& plan, bool back_driven,
                                   const std::atomic<bool>* stop) {
  if (!emulator.elastic_rig) {
    throw InputError(
        "identify: the emulator has no rig with elastic actuators whose figures would "
        "be known, emulator.rig.elastic; see configs/hil/stand.yaml");
  }
  EmulatedBench drives(emulator, std::make_unique<ElasticRig>(*emulator.elastic_rig));
  std::vector<std::unique_ptr<EmulatedBus>> owned;
  std::vector<CanBus*> buses;
  for (int b = 0; b < emulator.bus_count; ++b) {
    owned.push_back(std::make_unique<EmulatedBus>(drives, b));
    buses.push_back(owned.back().get());
  }
  drives.powerOn();
  const DriveConfig& drive = bench.drives.at(static_cast<std::size_t>(plan.drive));
  SdoExchange exchange(*buses.at(static_cast<std::size_t>(drive.bus)), drive.node, kPatience);
  std::vector<Record> records;
  for (const Posture posture : {Posture::kBlocked, Posture::kFree, Posture::kBackDriven}) {
    if (posture == Posture::kBackDriven && !back_driven) break;
    setStand(exchange, posture);
    SteppedRunner runner(forIdentification(bench, true), buses);
    runner.setStopFlag(stop);
    for (Record& r : takeRecords(runner, posture, plan, stop)) records.push_back(std::move(r));
  }
  return records;
}

double FigureTrials::mean() const {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double FigureTrials::rmsZ() const {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += std::pow((values[i] - truth) / sigmas[i], 2);
  }
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

int FigureTrials::withinTwoSigma() const {
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i] - truth) <= 2 * sigmas[i]) ++count;
  }
  return count;
}

int FigureTrials::good() const {
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double most = std::max(2 * sigmas[i], 0.05 * std::abs(truth));
    if (std::abs(values[i] - truth) <= most) ++count;
  }
  return count;
}

double IdentifyTrials::rmsZ() const { return rootMeanSquareOf(figures); }
double IdentifyTrials::percentWithinTwoSigma() const {
  return percentOf(figures, [](const FigureTrials& f) { return f.withinTwoSigma(); });
}
double IdentifyTrials::percentGood() const {
  return percentOf(figures, [](const FigureTrials& f) { return f.good(); });
}

bool IdentifyTrials::honest() const {
  const double within = percentWithinTwoSigma();
  return invalid == 0 && percentGood() >= 95 && within >= 90 && within <= 99 && rmsZ() >= 0.8 &&
         rmsZ() <= 1.25;
}

IdentifyTrials tryIdentification(const BenchConfig& bench, EmulatorConfig emulator,
                                 const ExcitationPlan& plan, const IdentifyOptions& options,
                                 int seeds, const std::atomic<bool>* stop) {
  IdentifyTrials out;
  for (int seed = 1; seed <= seeds; ++seed) {
    if (emulator.elastic_rig) {
      emulator.elastic_rig->noise_seed = static_cast<std::uint64_t>(seed);
    }
    const Identification found =
        identify(recordsOnStand(bench, emulator, plan, true, stop), options);
    ++out.seeds;
    if (!found.valid()) ++out.invalid;
    for (std::size_t i = 0; i < found.figures.list.size(); ++i) {
      const Figure& f = found.figures.list[i];
      if (seed == 1) {
        const double truth = trueFigure(emulator.elastic_rig->joint, f.key);
        out.figures.push_back({f.key, f.name, f.unit, truth, {}, {}});
      }
      out.figures[i].values.push_back(f.value);
      out.figures[i].sigmas.push_back(f.sigma);
    }
  }
  return out;
}

}  // namespace ballbot
