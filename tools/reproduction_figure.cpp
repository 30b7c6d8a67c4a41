#include "tools/reproduction_figure.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/angle.hpp"
#include "cosim/log_reader.hpp"
#include "experiment/contact_report.hpp"
#include "experiment/log_tables.hpp"
#include "experiment/run_config.hpp"
#include "experiment/scenario_frame.hpp"
#include "metrics/ee_step_metrics.hpp"
#include "report/svg_figure.hpp"

namespace ballbot {
namespace {

/// Enough for a line as wide as the picture.
constexpr std::size_t kSamples = 400;

/// The panels of one run's picture.
class Panels {
 public:
  Panels(const RunConfig& config, const RunLog& log)
      : log_(log), tables_(logTables(log)), reference_(config.reference()) {
    for (const Push& push : config.plant.plant.pushes) {
      shaded_.push_back({toSeconds(push.start), toSeconds(push.end())});
    }
    for (const ReportPhase& phase : contactPhases(log))
      shaded_.push_back({phase.start_s, phase.end_s});
    stride_ = std::max<std::size_t>(1, log.truth.size() / kSamples);
  }

  /// @param name  see PaperExperiment::panels
  SvgAxes panel(const std::string& name) const {
    SvgAxes axes = named(name);
    axes.x_label = "time [s]";
    axes.shaded = shaded_;
    return axes;
  }

 private:
  SvgAxes named(const std::string& name) const {
    SvgAxes axes;
    if (name == "ball") {
      axes.y_label = "ball [m]";
      for (int i = 0; i < 2; ++i)
        addWithReference(
            axes, i == 0 ? "x" : "y", i, ballAsked(i), 1,
            [i](const TruthFrame& m) { return m.state[kBallX + i]; },
            [this, i](double t) { return placeAt(t).ball[i]; });
    } else if (name == "ee") {
      axes.y_label = "end-effector [m]";
      for (int i = 0; i < 3; ++i)
        addWithReference(
            axes, std::string(1, static_cast<char>('x' + i)), i, eeAsked(i), 1,
            [i](const TruthFrame& m) { return m.p_WE[i]; },
            [this, i](double t) { return placeAt(t).ee[i]; });
    } else if (name == "ee_angles") {
      axes.y_label = "end-effector [deg]";
      const char* const names[] = {"yaw", "pitch", "roll"};
      for (int i = 0; i < 3; ++i)
        addWithReference(
            axes, names[i], i, reference_->eeMoves(), kDegPerRad,
            [this, i](const TruthFrame& m) { return poseOf(m)[3 + i]; },
            [this, i](double t) { return askedPose(t)[3 + i]; });
    } else if (name == "tilt") {
      axes.y_label = "base [deg]";
      addTruth(axes, "pitch", 0, kDegPerRad, [](const TruthFrame& m) { return m.state[kPitch]; });
      addTruth(axes, "roll", 1, kDegPerRad, [](const TruthFrame& m) { return m.state[kRoll]; });
    } else if (name == "arm") {
      axes.y_label = "arm joint [rad]";
      for (int i = 0; i < 3; ++i)
        addTruth(axes, "joint " + std::to_string(i + 1), i, 1,
                 [i](const TruthFrame& m) { return m.state[kArm1 + i]; });
    } else if (name == "force") {
      axes.y_label = "contact force [N]";
      addTruth(axes, "on the door", 0, 1, [](const TruthFrame& m) {
        return std::hypot(m.contact_force_W[0], m.contact_force_W[1]);
      });
      if (const LogTable* plan = findTable(tables_, "plan")) {
        SvgSeries asked{"asked for", 1, true, {}, {}};
        const auto& t = plan->column("time_s");
        const auto& x = plan->column("contact_asked_W_x");
        const auto& y = plan->column("contact_asked_W_y");
        for (std::size_t i = 0; i < t.size(); i += 3) {
          asked.x.push_back(t[i]);
          asked.y.push_back(std::hypot(x[i], y[i]));
        }
        axes.series.push_back(std::move(asked));
      }
    } else {
      axes.y_label = "door angle [deg]";
      addTruth(axes, "door", 0, kDegPerRad, [](const TruthFrame& m) { return m.door_angle; });
    }
    return axes;
  }

  PoseVector askedPose(double t) const {
    return reference_->eePose(kSimStart + durationFromSeconds(t));
  }
  PoseVector poseOf(const TruthFrame& m) const { return eePose(m, reference_->eePose(m.time)); }

  /// Whether a component has a weight at the run's end.
  bool ballAsked(int i) const { return placeAt(endTime()).ball_asked[i] > 0; }
  bool eeAsked(int i) const { return placeAt(endTime()).ee_asked[i] > 0; }
  double endTime() const { return log_.truth.empty() ? 0 : toSeconds(log_.truth.back().time); }
  PlaceReference placeAt(double t) const {
    return reference_->place(kSimStart + durationFromSeconds(t));
  }

  template <typename Value>
  void addTruth(SvgAxes& axes, const std::string& name, int colour, double scale,
                Value value) const {
    SvgSeries series{name, colour, false, {}, {}};
    for (std::size_t i = 0; i < log_.truth.size(); i += stride_) {
      series.x.push_back(toSeconds(log_.truth[i].time));
      series.y.push_back(scale * value(log_.truth[i]));
    }
    axes.series.push_back(std::move(series));
  }

  template <typename Value, typename Reference>
  void addWithReference(SvgAxes& axes, const std::string& name, int colour, bool asked,
                        double scale, Value value, Reference reference) const {
    addTruth(axes, name, colour, scale, value);
    if (!asked) return;
    SvgSeries series{name + " reference", colour, true, axes.series.back().x, {}};
    for (const double t : series.x) series.y.push_back(scale * reference(t));
    axes.series.push_back(std::move(series));
  }

  const RunLog& log_;
  std::vector<LogTable> tables_;
  std::shared_ptr<const MotionReference> reference_;
  std::vector<SvgSpan> shaded_;
  std::size_t stride_ = 1;
};

}  // namespace

std::string reproductionFigure(const Scenario& scenario, const std::string& log_file,
                               const std::vector<std::string>& panels) {
  const RunConfig config = readRunConfig(scenario);
  RunLog log = readRunLog(log_file);
  seeFromHome(config.home, log);
  const Panels source(config, log);
  std::vector<SvgAxes> axes;
  for (const std::string& name : panels) axes.push_back(source.panel(name));
  return svgFigure("", axes);
}

}  // namespace ballbot
