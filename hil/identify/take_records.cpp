#include "hil/identify/take_records.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr PdoEntry kCurrent{{0x6078, 0}, 16};
constexpr std::size_t kMostPdos = 4;
constexpr int kPdoBytes = 8;
// The loop that follows a free output's angle: soft, so that the drive's own response matters
// little.
constexpr double kStiffness = 20, kDamping = 2;  // [N m/rad], [N m s/rad]

/// The direction in which a joint has room for a whole swing; throws if neither has.
double directionOf(const DriveConfig& drive, double angle, double travel) {
  if (angle + travel < drive.limits.position_high) return 1;
  if (angle - travel > drive.limits.position_low) return -1;
  throw InputError(fmt::format(
      "identify: {} stands at {:.3g} deg and has no room to turn by {:.3g} deg between {:.3g} and "
      "{:.3g} deg; move it or make --travel-deg smaller",
      drive.name, kDegPerRad * angle, kDegPerRad * travel, kDegPerRad * drive.limits.position_low,
      kDegPerRad * drive.limits.position_high));
}

/// One session: commands go out and samples come in, cycle by cycle.
class Session {
 public:
  Session(BenchRunner& runner, const ExcitationPlan& plan, const std::atomic<bool>* stop)
      : runner_(runner), plan_(plan), stop_(stop) {
    runner_.engage();
    sample_ = &runner_.sample(0);
    start_ = sample_->joint_angle[drive()];
  }
  /// Whatever ends it, the torque is off then.
  ~Session() { runner_.release(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  Record record(const Excitation& e, Posture posture, double direction) {
    Record r;
    r.name = e.name;
    r.posture = posture;
    r.held_out = e.held_out;
    r.repeats = e.repeats;
    r.period = runner_.bench().config().cycleSeconds();
    const DriveScaling& scale = runner_.bench().config().drives[drive()].scaling;
    for (int n = 0; n < static_cast<int>(e.value.size()); ++n) {
      const BenchSample before = *sample_;
      step(torqueFor(e, direction, n));
      if (n < e.settle) continue;
      // What the drive was sent counts, not what was asked for.
      r.sent.push_back(scale.torque(scale.torqueCounts(command_.torque[drive()])));
      r.motor_torque.push_back(before.motor_torque[drive()]);
      r.joint_torque.push_back(before.joint_torque[drive()]);
      r.motor_angle.push_back(before.motor_angle[drive()]);
      r.joint_angle.push_back(before.joint_angle[drive()]);
    }
    return r;
  }

  double start() const { return start_; }

 private:
  std::size_t drive() const { return static_cast<std::size_t>(plan_.drive); }

  double torqueFor(const Excitation& e, double direction, int n) const {
    const auto i = static_cast<std::size_t>(n);
    if (!e.is_angle) return e.value[i];
    const double next = e.value[std::min(i + 1, e.value.size() - 1)];
    const double rate = (next - e.value[i]) / runner_.bench().config().cycleSeconds();
    const double torque =
        kStiffness * (start_ + direction * e.value[i] - sample_->joint_angle[drive()]) +
        kDamping * (direction * rate - sample_->joint_velocity[drive()]);
    // Softly, since the bench takes a command that stays the same for one that hangs.
    return plan_.amplitude_Nm * std::tanh(torque / plan_.amplitude_Nm);
  }

  void step(double torque) {
    if (stop_ != nullptr && stop_->load()) {
      runner_.release();
      runner_.requireGoodEnd();
      throw InterruptedError("identify: interrupted; the drives are off");
    }
    // Within the bench's own limits, so that it cuts nothing and what it sends is known here.
    const DriveLimits& limits = runner_.bench().config().drives[drive()].limits;
    const double most = limits.torque_rate * runner_.bench().config().cycleSeconds();
    double& told = command_.torque[drive()];
    told = std::clamp(torque, told - most, told + most);
    runner_.command(cycle_, command_);
    sample_ = &runner_.sample(++cycle_);
  }

  BenchRunner& runner_;
  const ExcitationPlan& plan_;
  const std::atomic<bool>* stop_;
  const BenchSample* sample_ = nullptr;
  BenchCommand command_;
  double start_ = 0;
  std::int64_t cycle_ = 0;
};

}  // namespace

BenchConfig forIdentification(BenchConfig config, bool with_current) {
  for (const DriveConfig& drive : config.drives) {
    config.safety.torque_mismatch =
        std::max(config.safety.torque_mismatch, 3 * drive.limits.torque);
  }
  const auto has = [](const PdoMapping& pdo) {
    return static_cast<bool>(pdo.find(kCurrent.object));
  };
  if (!with_current || std::any_of(config.inputs.begin(), config.inputs.end(), has)) return config;
  for (auto pdo = config.inputs.rbegin(); pdo != config.inputs.rend(); ++pdo) {
    if (pdo->bytes() + kCurrent.bits / 8 > kPdoBytes) continue;
    std::vector<PdoEntry> entries = pdo->entries();
    entries.push_back(kCurrent);
    *pdo = PdoMapping(entries);
    return config;
  }
  if (config.inputs.size() == kMostPdos) {
    throw InputError("identify: no TPDO has room for the motor's current 6078; make room in tpdo");
  }
  config.inputs.push_back(PdoMapping({kCurrent}));
  return config;
}

std::vector<Record> takeRecords(BenchRunner& runner, Posture posture, const ExcitationPlan& plan,
                                const std::atomic<bool>* stop) {
  const BenchConfig& config = runner.bench().config();
  const auto excitations = excitationsFor(posture, plan, config);
  Session session(runner, plan, stop);
  const double direction = posture == Posture::kFree
                               ? directionOf(config.drives[static_cast<std::size_t>(plan.drive)],
                                             session.start(), plan.travel_rad)
                               : 1;
  std::vector<Record> records;
  for (const Excitation& e : excitations) {
    if (e.needs_current && !showsCurrent(records)) continue;
    records.push_back(session.record(e, posture, direction));
  }
  runner.release();
  runner.requireGoodEnd();
  return records;
}

}  // namespace ballbot
