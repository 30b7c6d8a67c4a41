#include "hil/commissioning/commissioning.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "hil/commissioning/judgement.hpp"

namespace ballbot {
namespace {

using Kind = CommissioningTask::Kind;
using Verdict = Judgement::Verdict;

constexpr double kPatience = 90;      // for one task by hand [s]
constexpr double kPause = 10;         // at rest, before a person is asked to go on [s]
constexpr double kPulsePeriod = 0.4;  // [s]
constexpr int kPulses = 2;
constexpr double kArmTurn = 90 * kRadPerDeg, kOfItsRange = 0.9;

CommissioningTask standTask(const BenchConfig& config) {
  CommissioningTask t;
  t.kind = Kind::kStandStill;
  t.name = "stand still";
  t.text = fmt::format(
      "Robot upright in its stand, wheels off the ball, arm at its marks ({:.0f}, {:.0f}, {:.0f} "
      "deg). Let go.",
      kDegPerRad * config.commissioning.arm_pose[0], kDegPerRad * config.commissioning.arm_pose[1],
      kDegPerRad * config.commissioning.arm_pose[2]);
  return t;
}

CommissioningTask turnTask(const BenchConfig& config, int i) {
  const DriveConfig& d = config.drives[static_cast<std::size_t>(i)];
  CommissioningTask t;
  t.kind = Kind::kTurnJoint;
  t.drive = i;
  t.name = "turn " + d.name;
  if (i < 3) {
    t.angle = kTwoPi;
    t.text =
        fmt::format("Turn {} by hand, one full turn along its arrow, from mark to mark.", d.name);
    return t;
  }
  // Where there is little room along the arrow, against it.
  const double start = config.commissioning.arm_pose[static_cast<std::size_t>(i - 3)];
  const double along = kOfItsRange * (d.limits.position_high - start);
  const double against = kOfItsRange * (start - d.limits.position_low);
  const bool forwards = along >= std::min(kArmTurn, against);
  t.angle = forwards ? std::min(kArmTurn, along) : -std::min(kArmTurn, against);
  t.text = fmt::format("Turn {} by hand by {:.0f} deg {} its arrow, by a set square; let it rest.",
                       d.name, std::abs(t.angle) * kDegPerRad, forwards ? "along" : "against");
  return t;
}

CommissioningTask tiltTask(std::size_t axis, const char* name, const char* text) {
  CommissioningTask t;
  t.kind = Kind::kTiltBase;
  t.axis[axis] = 1;
  t.name = name;
  t.text = text;
  return t;
}

CommissioningTask torqueTask(const BenchConfig& config, int i) {
  const DriveConfig& d = config.drives[static_cast<std::size_t>(i)];
  CommissioningTask t;
  t.kind = Kind::kTorque;
  t.drive = i;
  t.name = "torque on " + d.name;
  t.text = fmt::format("{} gets {:.2f} Nm to and fro for {:.1f} s. Hands off.", d.name,
                       config.commissioning.torque_share * d.limits.torque, kPulses * kPulsePeriod);
  return t;
}

class Procedure {
 public:
  Procedure(BenchRunner& runner, CommissioningPerson& person)
      : runner_(runner),
        person_(person),
        config_(runner.bench().config()),
        watch_(config_.cycleSeconds(), config_.safety.rest_velocity) {}

  CommissioningReport run() {
    const auto tasks = commissioningTasks(config_);
    for (const CommissioningTask& task : tasks) {
      if (task.kind != Kind::kTorque) note(task, byHand(task));
      // Nothing that follows means anything.
      if (task.kind == Kind::kStandStill && !allGood()) return std::move(report_);
    }
    if (!allGood()) return std::move(report_);
    if (!person_.allowsTorque()) {
      report_.rows.push_back({"torque", false, "the person did not allow torque"});
      return std::move(report_);
    }
    for (const CommissioningTask& task : tasks) {
      if (task.kind != Kind::kTorque) continue;
      note(task, underTorque(task));
      if (!allGood()) return std::move(report_);
    }
    report_.passed = true;
    return std::move(report_);
  }

 private:
  bool allGood() const {
    return std::all_of(report_.rows.begin(), report_.rows.end(),
                       [](const CommissioningRow& row) { return row.good; });
  }

  void note(const CommissioningTask& task, const Judgement& j) {
    person_.hear(task, j.words);
    report_.rows.push_back({task.name, j.verdict == Verdict::kGood, j.words});
  }

  Judgement judge(const CommissioningTask& task) const {
    if (!watch_.started()) return {Verdict::kWait, "the robot did not come to rest"};
    if (task.kind == Kind::kStandStill) return judgeStand(config_, watch_);
    if (task.kind == Kind::kUpright) return judgeUpright(watch_);
    if (!watch_.hasMoved()) return {Verdict::kWait, "nothing moved"};
    return task.kind == Kind::kTurnJoint ? judgeTurn(config_, task, watch_)
                                         : judgeTilt(task, watch_);
  }

  Judgement byHand(const CommissioningTask& task) {
    const auto cycles = [&](double seconds) {
      return static_cast<int>(std::lround(seconds / config_.cycleSeconds()));
    };
    watch_.begin();
    person_.begin(task);
    Judgement j;
    int paused = 0;
    for (int left = cycles(kPatience); left > 0; --left) {
      watch_.add(runner_.watch());
      if (!watch_.started() || !watch_.atRest()) {
        paused = 0;
        continue;
      }
      j = judge(task);
      if (j.verdict != Verdict::kWait) return j;
      if (++paused % cycles(kPause) == 0) person_.hear(task, j.words + ". Go on");
    }
    if (j.words.empty()) j = judge(task);
    return {Verdict::kWrong, j.words};
  }

  // Whatever the bench's own checks find first is the finding.
  Judgement underTorque(const CommissioningTask& task) {
    const DriveConfig& drive = config_.drives[static_cast<std::size_t>(task.drive)];
    const double peak = config_.commissioning.torque_share * drive.limits.torque;
    const int length = static_cast<int>(std::lround(kPulsePeriod / config_.cycleSeconds()));
    PulseWatch pulse(config_, task.drive);
    BenchCommand command;
    person_.begin(task);
    try {
      runner_.engage();
      report_.torque_was_on = true;
      pulse.add(0, runner_.sample(0));
      for (int n = 0; n < config_.safety.ramp_cycles + kPulses * length; ++n) {
        command.torque[static_cast<std::size_t>(task.drive)] =
            peak * std::sin(kTwoPi * (n + 1) / length);
        runner_.command(n, command);
        const BenchSample& sample = runner_.sample(n + 1);
        pulse.add(sentBy(n, command.torque[static_cast<std::size_t>(task.drive)]), sample);
      }
      runner_.release();
      runner_.requireGoodEnd();
    } catch (const LostParticipantError& e) {
      return {Verdict::kWrong, e.what()};
    }
    return judgePulse(config_, task.drive, pulse);
  }

  /// The bench lets torque grow over its first cycles.
  double sentBy(int n, double torque) const {
    const int ramp = config_.safety.ramp_cycles;
    return n + 1 < ramp ? torque * (n + 1) / ramp : torque;
  }

  BenchRunner& runner_;
  CommissioningPerson& person_;
  const BenchConfig& config_;
  HandWatch watch_;
  CommissioningReport report_;
};

}  // namespace

std::vector<CommissioningTask> commissioningTasks(const BenchConfig& config) {
  std::vector<CommissioningTask> tasks{standTask(config)};
  for (int i = 0; i < kDriveCount; ++i) tasks.push_back(turnTask(config, i));
  CommissioningTask upright;
  upright.kind = Kind::kUpright;
  upright.name = "upright again";
  upright.text = "Upright again, and hold it still.";
  tasks.push_back(tiltTask(0, "tilt to the right", "Tilt it to its right by 20 deg; hold it."));
  tasks.push_back(upright);
  tasks.push_back(tiltTask(1, "tilt forwards", "Tilt it forwards by 20 deg; hold it."));
  tasks.push_back(upright);
  tasks.push_back(tiltTask(2, "turn to the left", "Turn it to its left by 45 deg; hold it."));
  for (int i = 0; i < kDriveCount; ++i) tasks.push_back(torqueTask(config, i));
  return tasks;
}

CommissioningReport commission(BenchRunner& runner, CommissioningPerson& person) {
  return Procedure(runner, person).run();
}

}  // namespace ballbot
