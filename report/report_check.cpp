#include "report/report_check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {

namespace {

constexpr int kChannelCount = 6;  // colours of the page's palette

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw InputError("report: " + where + " " + what);
}

void checkTimes(const std::string& where, const std::vector<double>& t) {
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (!std::isfinite(t[i])) refuse(where, fmt::format("has the time {} at index {}", t[i], i));
    if (i > 0 && t[i] <= t[i - 1])
      refuse(where, fmt::format("has times that do not ascend: {} s after {} s at index {}", t[i],
                                t[i - 1], i));
  }
}

void checkLength(const std::string& where, const std::string& what, std::size_t length,
                 std::size_t times) {
  if (length != times) refuse(where, fmt::format("has {} {} for {} times", length, what, times));
}

template <typename Series>
std::string nameOf(const std::string& axes, const Series& series) {
  return fmt::format("series '{}' of '{}'", series.name, axes);
}

void checkChannel(const std::string& where, int channel) {
  if (channel < 0 || channel >= kChannelCount)
    refuse(where,
           fmt::format("has colour channel {}, must be 0 to {}", channel, kChannelCount - 1));
}

void checkLane(const StateLane& lane) {
  for (std::size_t i = 0; i < lane.stretches.size(); ++i) {
    const LaneStretch& s = lane.stretches[i];
    const bool ascends = i == 0 || s.start_s >= lane.stretches[i - 1].end_s;
    if (std::isfinite(s.start_s) && std::isfinite(s.end_s) && s.end_s >= s.start_s && ascends)
      continue;
    refuse("lane '" + lane.name + "'",
           fmt::format(
               "has '{}' from {} s to {} s at index {}, {}", s.word, s.start_s, s.end_s, i,
               ascends ? "which is no stretch of time" : "before the one before it has ended"));
  }
}

void checkTable(const ReportTable& table) {
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.rows[i].cells.size() == table.columns.size()) continue;
    refuse("table '" + table.title + "'",
           fmt::format("has {} cells in row {} for {} columns", table.rows[i].cells.size(), i,
                       table.columns.size()));
  }
}

void checkFact(const ReportData& data, const ReportFact& fact) {
  const bool found = std::any_of(data.documents.begin(), data.documents.end(),
                                 [&](const auto& d) { return d.name == fact.document; });
  if (!fact.document.empty() && !found)
    refuse("fact '" + fact.name + "'", "opens '" + fact.document + "', which is no document of it");
}

void checkGroup(const PlotGroup& group) {
  for (const PlotAxes& axes : group.axes) {
    for (const PlotSeries& series : axes.series) {
      const std::string where = nameOf(axes.quantity, series);
      checkTimes(where, series.t);
      checkLength(where, "values", series.values.size(), series.t.size());
      checkChannel(where, series.channel);
    }
  }
  for (const StateLane& lane : group.lanes) checkLane(lane);
  for (const PathAxes& axes : group.paths) {
    for (const PathSeries& series : axes.series) {
      const std::string where = nameOf(axes.title, series);
      checkTimes(where, series.t);
      checkLength(where, "x values", series.x.size(), series.t.size());
      checkLength(where, "y values", series.y.size(), series.t.size());
      checkChannel(where, series.channel);
    }
  }
}

void checkReplay(const ReportReplay& replay, const std::string& urdf_text) {
  if (urdf_text.empty()) refuse("the replay", "needs the text of the robot's URDF");
  if (replay.t.empty()) refuse("the replay", "has no times");
  checkTimes("the replay", replay.t);
  const std::size_t times = replay.t.size();
  for (const auto& body : replay.bodies)
    checkLength("replay of link '" + body.link + "'", "poses", body.poses.size(), times);
  for (const auto& joint : replay.joints)
    checkLength("replay of joint '" + joint.name + "'", "angles", joint.angle.size(), times);
  for (const auto& frame : replay.frames)
    checkLength("replay of frame '" + frame.name + "'", "poses", frame.poses.size(), times);
  for (const auto& force : replay.forces) {
    const std::string where = "replay of force '" + force.name + "'";
    checkLength(where, "points", force.point_W.size(), times);
    checkLength(where, "forces", force.force_W.size(), times);
  }
  for (const auto& object : replay.objects) {
    if (object.poses.size() != 1)
      checkLength("replay of object '" + object.name + "'", "poses", object.poses.size(), times);
  }
  const bool follows = std::any_of(replay.bodies.begin(), replay.bodies.end(),
                                   [&](const auto& b) { return b.link == replay.followed_link; });
  if (!follows)
    refuse("the replay",
           "follows link '" + replay.followed_link + "', which is not among its bodies");
}

}  // namespace

void checkReportData(const ReportData& data, const std::string& urdf_text) {
  if (!(std::isfinite(data.start_s) && std::isfinite(data.end_s) && data.end_s > data.start_s))
    refuse("the run",
           fmt::format("spans {} s to {} s, must have a duration", data.start_s, data.end_s));
  for (const PlotGroup& group : data.groups) checkGroup(group);
  for (const ReportTable& table : data.tables) checkTable(table);
  for (const ReportFact& fact : data.headline) checkFact(data, fact);
  if (data.view && !(data.view->start_s >= data.start_s && data.view->end_s <= data.end_s &&
                     data.view->end_s > data.view->start_s))
    refuse("the view", fmt::format("spans {} s to {} s, must lie in the run's {} s to {} s",
                                   data.view->start_s, data.view->end_s, data.start_s, data.end_s));
  for (const ReportPhase& phase : data.phases) {
    if (!(std::isfinite(phase.start_s) && std::isfinite(phase.end_s) &&
          phase.end_s >= phase.start_s))
      refuse("phase '" + phase.label + "'",
             fmt::format("lasts from {} s to {} s", phase.start_s, phase.end_s));
  }
  if (data.replay) checkReplay(*data.replay, urdf_text);
}

}  // namespace ballbot
