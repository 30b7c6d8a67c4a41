#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace ballbot {

// What the report page of a run shows, in plain values: whoever fills it needs to know nothing of
// the page, and the page nothing of the run. Times are seconds of simulated time, ascending;
// positions are in the world frame W, z up [m]; quaternions are w x y z and take body coordinates
// to W. A value that is not finite is a gap: the line breaks, the frame or arrow is not drawn.

/// Role of a line; it decides the stroke (solid, dashed, dash-dotted, dotted).
enum class SeriesStyle { kMeasured, kReference, kEstimated, kCommanded };

/// One line over time. Series of one axes with the same `channel` share a colour, so give
/// x measured and x reference channel 0, y measured and y reference channel 1.
struct PlotSeries {
  std::string name;  ///< as the legend shows it, e.g. "x measured"
  SeriesStyle style = SeriesStyle::kMeasured;
  int channel = 0;  ///< 0 to 5
  std::vector<double> t;
  std::vector<double> values;
};

/// A horizontal line that a quantity should respect. It is drawn where the data comes near it and
/// never squeezes the data.
struct PlotLimit {
  std::string name;
  double value = 0;
};

/// One pair of axes over time.
struct PlotAxes {
  std::string quantity;  ///< label of the vertical axis, e.g. "tilt"
  std::string unit;      ///< e.g. "deg"; empty for a pure number
  std::vector<PlotSeries> series;
  std::vector<PlotLimit> limits;
};

/// A curve in a plane, e.g. the way of the ball seen from above.
struct PathSeries {
  std::string name;
  SeriesStyle style = SeriesStyle::kMeasured;
  int channel = 0;
  std::vector<double> t, x, y;
};

/// Axes for curves in a plane; both directions have the same scale.
struct PathAxes {
  std::string title;
  std::string x_label = "x", y_label = "y", unit = "m";
  std::vector<PathSeries> series;
};

/// How much attention a state wants; it decides the shade of its stretch.
enum class LaneTone { kQuiet, kReady, kActive, kWarning, kBad };

/// A stretch of time in which something was in one state, which its word names.
struct LaneStretch {
  double start_s = 0, end_s = 0;
  std::string word;
  LaneTone tone = LaneTone::kQuiet;
};

/// The states of one thing over time; stretches ascend and do not overlap.
struct StateLane {
  std::string name;
  std::vector<LaneStretch> stretches;
};

/// Axes drawn under each other under one heading, as the panels of a paper's figure.
struct PlotGroup {
  std::string title;
  std::string caption;  ///< one or two sentences: what to look for; may be empty
  std::vector<PlotAxes> axes = {};
  std::vector<PathAxes> paths = {};
  std::vector<StateLane> lanes = {};  ///< above the axes, over the same time
};

/// A stretch of time shaded in every plot.
struct ReportPhase {
  enum class Kind { kPush, kContact, kHold, kFault };
  Kind kind = Kind::kPush;
  double start_s = 0, end_s = 0;
  std::string label;  ///< e.g. "20 N along y"
};

/// What the scenario demanded and what came out.
struct ReportRequirement {
  std::string name;
  double value = 0;   ///< not finite: the run produced no such number
  std::string limit;  ///< e.g. "< 20", "5 to 20"
  std::string unit;
  bool passed = false;
};

/// A figure of the run that nobody demanded anything of.
struct ReportMetric {
  std::string section;  ///< rows of the same section stand together; may be empty
  std::string name;
  double value = 0;
  std::string unit;
};

/// A name and a text: a line of the manifest.
struct ReportFact {
  std::string name, text;
  std::string document = {};  ///< name of the document to open from here; may be empty
};

/// A table of words. Rows that are marked stand out.
struct ReportTable {
  struct Row {
    std::vector<std::string> cells;
    bool marked = false;
  };
  std::string title, caption;
  std::vector<std::string> columns;
  std::vector<Row> rows;
  bool first = false;  ///< before the figures; else after them
};

/// What the page shows when it is opened, instead of all: a stretch of time, and the present time.
struct ReportView {
  double start_s = 0, end_s = 0, at_s = 0;
};

/// A longer text, folded away until someone opens it: the scenario, the configuration.
struct ReportDocument {
  std::string name, text;
};

struct ReplayPose {
  std::array<double, 3> p_W{};
  std::array<double, 4> quat_W{1, 0, 0, 0};
};

/// A link of the URDF that moves freely in the world, with everything its joints carry.
struct ReplayBody {
  std::string link;
  std::vector<ReplayPose> poses;
};

struct ReplayJoint {
  std::string name;           ///< of the URDF
  std::vector<double> angle;  ///< [rad]
};

/// A coordinate frame drawn as a triad: solid if measured, translucent if it is a reference.
struct ReplayFrame {
  std::string name;
  SeriesStyle style = SeriesStyle::kMeasured;
  std::vector<ReplayPose> poses;
};

/// A force drawn as an arrow that points along it and ends where it acts.
struct ReplayForce {
  std::string name;
  ReportPhase::Kind kind = ReportPhase::Kind::kPush;
  std::vector<std::array<double, 3>> point_W;
  std::vector<std::array<double, 3>> force_W;  ///< [N]
};

/// A part of the surroundings: a wall, a door leaf.
struct ReplayObject {
  std::string name;
  std::array<double, 3> box_size{};  ///< along its own axes, about its centre [m]
  std::vector<ReplayPose> poses;     ///< one per time, or a single one if it never moves
};

struct ReportReplay {
  std::vector<double> t;
  std::vector<ReplayBody> bodies;
  std::vector<ReplayJoint> joints;
  std::vector<ReplayFrame> frames;
  std::vector<ReplayForce> forces;
  std::vector<ReplayObject> objects;
  std::string followed_link = "base";  ///< where a following camera looks; one of `bodies`
};

struct ReportData {
  std::string title;     ///< e.g. "Push recovery"
  std::string subtitle;  ///< what it was, in one sentence
  bool passed = false;
  std::string verdict;  ///< why, in a few words: "5 of 5 requirements met", "fell at 4.40 s"
  std::vector<ReportFact>
      headline;  ///< three to five facts for the header: duration, seed, version
  std::vector<ReportRequirement> requirements;
  std::vector<ReportMetric> metrics;
  std::vector<PlotGroup> groups;
  std::vector<ReportPhase> phases;
  std::optional<ReportReplay> replay;  ///< nothing where nobody knows the true state (real drives)
  std::vector<ReportFact> manifest;
  std::vector<ReportDocument> documents;
  double start_s = 0, end_s = 0;  ///< what the time axes span
  std::vector<ReportTable> tables = {};
  std::optional<ReportView> view = {};
};

}  // namespace ballbot
