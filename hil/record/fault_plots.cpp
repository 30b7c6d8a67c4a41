#include "hil/record/fault_plots.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "core/angle.hpp"

namespace ballbot {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr int kWheels = 3;

using Value = std::function<double(const CycleRecord&)>;

class Plotter {
 public:
  explicit Plotter(const FaultRecord& record) : record_(record) {
    const auto& cycles = record.recorder.cycles();
    for (std::size_t i = 0; i < cycles.size(); ++i) t_.push_back(record.seconds(cycles[i].time_ns));
  }

  PlotSeries line(std::string name, SeriesStyle style, int channel, const Value& value) const {
    PlotSeries series{std::move(name), style, channel, t_, {}};
    const auto& cycles = record_.recorder.cycles();
    for (std::size_t i = 0; i < cycles.size(); ++i) series.values.push_back(value(cycles[i]));
    return series;
  }

  /// A measurement of a drive: a gap where its data did not come.
  PlotSeries measured(int channel, int drive, const Value& value) const {
    const auto n = static_cast<std::size_t>(drive);
    return line(nameOf(drive), SeriesStyle::kMeasured, channel,
                [n, value](const CycleRecord& r) { return r.stale[n] == 0 ? value(r) : kGap; });
  }
  const std::string& nameOf(int drive) const {
    return record_.config().drives[static_cast<std::size_t>(drive)].name;
  }

  /// The drive that the first check speaks of, then the others.
  std::vector<int> driveOrder() const {
    std::vector<int> order;
    const int first = record_.recorder.first().finding.drive;
    if (first >= 0 && first < kDriveCount) order.push_back(first);
    for (int i = 0; i < kDriveCount; ++i) {
      if (order.empty() || i != order.front()) order.push_back(i);
    }
    return order;
  }

  PlotGroup torque() const {
    PlotGroup group;
    group.title = "Torque: asked, sent and felt";
    group.caption =
        "Asked: by the controller, with the joint's PD law. Sent: after rate, limit, ramp or "
        "damping. Felt: what the drive measures at its spring.";
    for (const int i : driveOrder()) {
      const auto n = static_cast<std::size_t>(i);
      const double limit = record_.config().drives[n].limits.torque;
      PlotAxes axes{nameOf(i) + " torque", "Nm", {}, {{"limit", limit}, {"limit", -limit}}};
      axes.series.push_back(
          measured(0, i, [n](const CycleRecord& r) { return r.sample.joint_torque[n]; }));
      axes.series.back().name = "felt";
      axes.series.push_back(line("sent", SeriesStyle::kCommanded, 0,
                                 [n](const CycleRecord& r) { return r.torque[n]; }));
      axes.series.push_back(line("asked", SeriesStyle::kReference, 1,
                                 [n](const CycleRecord& r) { return r.asked[n]; }));
      group.axes.push_back(std::move(axes));
    }
    return group;
  }

  /// One pair of axes for the wheels, one for the arm.
  void pair(PlotGroup& group, const std::string& quantity, const std::string& unit,
            const std::function<double(const CycleRecord&, std::size_t)>& value) const {
    for (int first : {0, kWheels}) {
      PlotAxes axes{(first == 0 ? "wheels, " : "arm, ") + quantity, unit, {}, {}};
      for (int i = first; i < first + kWheels; ++i) {
        const auto n = static_cast<std::size_t>(i);
        axes.series.push_back(
            measured(i - first, i, [n, &value](const CycleRecord& r) { return value(r, n); }));
      }
      group.axes.push_back(std::move(axes));
    }
  }

  PlotGroup motion() const {
    PlotGroup group;
    group.title = "Joints";
    group.caption =
        "The last two: motor angle minus joint angle minus torque over stiffness, which a healthy "
        "spring keeps near zero.";
    pair(group, "joint angle", "rad",
         [](const CycleRecord& r, std::size_t n) { return r.sample.joint_angle[n]; });
    pair(group, "joint velocity", "rad/s",
         [](const CycleRecord& r, std::size_t n) { return r.sample.joint_velocity[n]; });
    const BenchConfig& config = record_.config();
    pair(group, "what the spring does not explain", "mrad",
         [&config](const CycleRecord& r, std::size_t n) {
           return 1e3 * (r.sample.motor_angle[n] - r.sample.joint_angle[n] -
                         r.sample.joint_torque[n] / config.drives[n].scaling.spring_stiffness);
         });
    const double limit = 1e3 * config.safety.spring_mismatch;
    for (auto axes = group.axes.end() - 2; axes != group.axes.end(); ++axes) {
      axes->limits = {{"limit", limit}, {"limit", -limit}};
    }
    return group;
  }

  PlotAxes threeAxes(const char* quantity, const char* unit,
                     const std::array<double, 3> BenchSample::*values) const {
    static constexpr const char* kNames[] = {"x", "y", "z"};
    PlotAxes axes{quantity, unit, {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      axes.series.push_back(line(kNames[i], SeriesStyle::kMeasured, static_cast<int>(i),
                                 [values, i](const CycleRecord& r) {
                                   return r.imu_stale == 0 ? (r.sample.*values)[i] : kGap;
                                 }));
    }
    return axes;
  }

  PlotGroup imu() const {
    PlotGroup group;
    group.title = "IMU, axes of the base";
    group.axes.push_back(threeAxes("specific force", "m/s^2", &BenchSample::accel));
    group.axes.push_back(threeAxes("angular rate", "rad/s", &BenchSample::gyro));
    PlotAxes tilt{"tilt as the bench reckons it", "deg", {}, {}};
    tilt.limits.push_back({"limit", kDegPerRad * record_.config().safety.tilt});
    tilt.series.push_back(line("tilt", SeriesStyle::kEstimated, 0, [](const CycleRecord& r) {
      return kDegPerRad * static_cast<double>(r.tilt);
    }));
    group.axes.push_back(std::move(tilt));
    return group;
  }

  PlotGroup loop() const {
    PlotGroup group;
    group.title = "Misses";
    PlotAxes misses{"cycles since the last whole set of data", "", {}, {}};
    for (int i = 0; i < kDriveCount; ++i) {
      const auto n = static_cast<std::size_t>(i);
      misses.series.push_back(line(nameOf(i), SeriesStyle::kMeasured, i, [n](const CycleRecord& r) {
        return static_cast<double>(r.stale[n]);
      }));
    }
    misses.series.push_back(line("IMU", SeriesStyle::kEstimated, 0, [](const CycleRecord& r) {
      return static_cast<double>(r.imu_stale);
    }));
    group.axes.push_back(std::move(misses));
    if (!record_.recorder.hasClock()) return group;
    group.title = "Misses and lateness of the loop";
    PlotAxes late{"late", "us", {}, {}};
    late.series.push_back(line("SYNC", SeriesStyle::kMeasured, 0, [](const CycleRecord& r) {
      return 1e-3 * static_cast<double>(r.wake_late_ns);
    }));
    late.series.push_back(line("command", SeriesStyle::kMeasured, 1, [](const CycleRecord& r) {
      return 1e-3 * static_cast<double>(r.act_late_ns);
    }));
    group.axes.push_back(std::move(late));
    PlotAxes skipped{"periods skipped before the cycle", "", {}, {}};
    skipped.series.push_back(line("skipped", SeriesStyle::kMeasured, 1, [](const CycleRecord& r) {
      return static_cast<double>(r.skipped);
    }));
    group.axes.push_back(std::move(skipped));
    return group;
  }

 private:
  const FaultRecord& record_;
  std::vector<double> t_;
};

}  // namespace

std::vector<PlotGroup> faultPlots(const FaultRecord& record) {
  const Plotter plot(record);
  return {plot.torque(), plot.motion(), plot.imu(), plot.loop()};
}

}  // namespace ballbot
