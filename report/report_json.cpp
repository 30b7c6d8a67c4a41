#include "report/report_json.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "report/base64.hpp"
#include "report/sample_selection.hpp"

namespace ballbot {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormatVersion = 1;

const char* toText(SeriesStyle style) {
  switch (style) {
    case SeriesStyle::kMeasured:
      return "measured";
    case SeriesStyle::kReference:
      return "reference";
    case SeriesStyle::kEstimated:
      return "estimated";
    case SeriesStyle::kCommanded:
      return "commanded";
  }
  return "measured";
}

const char* toText(ReportPhase::Kind kind) {
  switch (kind) {
    case ReportPhase::Kind::kPush:
      return "push";
    case ReportPhase::Kind::kContact:
      return "contact";
    case ReportPhase::Kind::kHold:
      return "hold";
    case ReportPhase::Kind::kFault:
      return "fault";
  }
  return "push";
}

const char* toText(LaneTone tone) {
  switch (tone) {
    case LaneTone::kQuiet:
      return "quiet";
    case LaneTone::kReady:
      return "ready";
    case LaneTone::kActive:
      return "active";
    case LaneTone::kWarning:
      return "warning";
    case LaneTone::kBad:
      return "bad";
  }
  return "quiet";
}

/// Lists every distinct vector of times once.
class TimeTable {
 public:
  std::size_t indexOf(std::vector<double> t) {
    const auto found = std::find(times_.begin(), times_.end(), t);
    if (found != times_.end()) return static_cast<std::size_t>(found - times_.begin());
    times_.push_back(std::move(t));
    return times_.size() - 1;
  }

  Json json() const {
    Json list = Json::array();
    for (const auto& t : times_) list.push_back(encoded(t));
    return list;
  }

 private:
  static Json encoded(const std::vector<double>& t) {
    constexpr double kNanosecond = 1e-9;
    const double start = t.empty() ? 0 : t.front();
    const double step = t.size() < 2 ? 0 : (t.back() - start) / static_cast<double>(t.size() - 1);
    bool even = true;
    for (std::size_t i = 0; i < t.size() && even; ++i)
      even = std::abs(t[i] - (start + static_cast<double>(i) * step)) < kNanosecond;
    if (even) return {{"start", start}, {"step", step}, {"count", t.size()}};
    return {{"values", base64Float32(t)}};
  }

  std::vector<std::vector<double>> times_;
};

/// Puts the series of one pair of axes into `list`. Series over the same times are thinned
/// together, so that they still share their times afterwards.
template <typename Series, typename Columns, typename Encode>
Json thinnedSeries(const std::vector<Series>& all, std::size_t wanted, TimeTable& times,
                   Columns columns_of, Encode encode) {
  Json list = Json::array();
  for (const Series& series : all) {
    std::vector<const std::vector<double>*> columns;
    for (const Series& other : all) {
      if (other.t == series.t) columns_of(other, columns);
    }
    const auto kept = selectExtremes(columns, wanted);
    Json entry = {{"name", series.name},
                  {"style", toText(series.style)},
                  {"channel", series.channel},
                  {"time", times.indexOf(selected(series.t, kept))}};
    encode(series, kept, entry);
    list.push_back(std::move(entry));
  }
  return list;
}

Json axesJson(const PlotAxes& axes, std::size_t wanted, TimeTable& times) {
  Json limits = Json::array();
  for (const PlotLimit& limit : axes.limits)
    limits.push_back({{"name", limit.name}, {"value", limit.value}});
  Json series = thinnedSeries(
      axes.series, wanted, times,
      [](const PlotSeries& s, auto& columns) { columns.push_back(&s.values); },
      [](const PlotSeries& s, const auto& kept, Json& entry) {
        entry["values"] = base64Float32(selected(s.values, kept));
      });
  return {{"quantity", axes.quantity},
          {"unit", axes.unit},
          {"limits", std::move(limits)},
          {"series", std::move(series)}};
}

Json pathJson(const PathAxes& axes, std::size_t wanted, TimeTable& times) {
  Json series = thinnedSeries(
      axes.series, wanted, times,
      [](const PathSeries& s, auto& columns) {
        columns.push_back(&s.x);
        columns.push_back(&s.y);
      },
      [](const PathSeries& s, const auto& kept, Json& entry) {
        entry["x"] = base64Float32(selected(s.x, kept));
        entry["y"] = base64Float32(selected(s.y, kept));
      });
  return {{"title", axes.title},
          {"x_label", axes.x_label},
          {"y_label", axes.y_label},
          {"unit", axes.unit},
          {"series", std::move(series)}};
}

Json lanesJson(const std::vector<StateLane>& lanes) {
  Json list = Json::array();
  for (const StateLane& lane : lanes) {
    Json stretches = Json::array();
    for (const LaneStretch& s : lane.stretches) {
      stretches.push_back(
          {{"start", s.start_s}, {"end", s.end_s}, {"word", s.word}, {"tone", toText(s.tone)}});
    }
    list.push_back({{"name", lane.name}, {"stretches", std::move(stretches)}});
  }
  return list;
}

Json tablesJson(const std::vector<ReportTable>& tables) {
  Json list = Json::array();
  for (const ReportTable& table : tables) {
    Json rows = Json::array();
    for (const ReportTable::Row& row : table.rows) {
      rows.push_back({{"cells", row.cells}, {"marked", row.marked}});
    }
    list.push_back({{"title", table.title},
                    {"caption", table.caption},
                    {"columns", table.columns},
                    {"rows", std::move(rows)},
                    {"first", table.first}});
  }
  return list;
}

Json groupsJson(const ReportData& data, std::size_t wanted, TimeTable& times) {
  Json list = Json::array();
  for (const PlotGroup& group : data.groups) {
    Json axes = Json::array(), paths = Json::array();
    for (const PlotAxes& a : group.axes) axes.push_back(axesJson(a, wanted, times));
    for (const PathAxes& p : group.paths) paths.push_back(pathJson(p, wanted, times));
    list.push_back({{"title", group.title},
                    {"caption", group.caption},
                    {"axes", std::move(axes)},
                    {"paths", std::move(paths)},
                    {"lanes", lanesJson(group.lanes)}});
  }
  return list;
}

/// Rows x y z qw qx qy qz.
std::string encodedPoses(const std::vector<ReplayPose>& poses) {
  std::vector<double> rows;
  rows.reserve(7 * poses.size());
  for (const ReplayPose& pose : poses) {
    rows.insert(rows.end(), pose.p_W.begin(), pose.p_W.end());
    rows.insert(rows.end(), pose.quat_W.begin(), pose.quat_W.end());
  }
  return base64Float32(rows);
}

std::string encodedVectors(const std::vector<std::array<double, 3>>& vectors) {
  std::vector<double> rows;
  rows.reserve(3 * vectors.size());
  for (const auto& v : vectors) rows.insert(rows.end(), v.begin(), v.end());
  return base64Float32(rows);
}

Json replayJson(const ReportReplay& replay, const std::string& urdf_text, double rate_Hz,
                TimeTable& times) {
  const auto kept = selectSpaced(replay.t, 1.0 / rate_Hz);
  Json bodies = Json::array(), joints = Json::array(), frames = Json::array(),
       forces = Json::array(), objects = Json::array();
  for (const auto& body : replay.bodies)
    bodies.push_back({{"link", body.link}, {"poses", encodedPoses(selected(body.poses, kept))}});
  for (const auto& joint : replay.joints)
    joints.push_back(
        {{"name", joint.name}, {"angles", base64Float32(selected(joint.angle, kept))}});
  for (const auto& frame : replay.frames)
    frames.push_back({{"name", frame.name},
                      {"style", toText(frame.style)},
                      {"poses", encodedPoses(selected(frame.poses, kept))}});
  for (const auto& force : replay.forces)
    forces.push_back({{"name", force.name},
                      {"kind", toText(force.kind)},
                      {"points", encodedVectors(selected(force.point_W, kept))},
                      {"forces", encodedVectors(selected(force.force_W, kept))}});
  for (const auto& object : replay.objects) {
    const bool moves = object.poses.size() > 1;
    objects.push_back(
        {{"name", object.name},
         {"size", object.box_size},
         {"moves", moves},
         {"poses", encodedPoses(moves ? selected(object.poses, kept) : object.poses)}});
  }
  return {{"urdf", urdf_text},
          {"time", times.indexOf(selected(replay.t, kept))},
          {"followed_link", replay.followed_link},
          {"bodies", std::move(bodies)},
          {"joints", std::move(joints)},
          {"frames", std::move(frames)},
          {"forces", std::move(forces)},
          {"objects", std::move(objects)}};
}

Json factsJson(const std::vector<ReportFact>& facts) {
  Json list = Json::array();
  for (const ReportFact& fact : facts)
    list.push_back({{"name", fact.name}, {"text", fact.text}, {"document", fact.document}});
  return list;
}

Json requirementsJson(const std::vector<ReportRequirement>& requirements) {
  Json list = Json::array();
  for (const ReportRequirement& r : requirements)
    list.push_back({{"name", r.name},
                    {"value", r.value},
                    {"limit", r.limit},
                    {"unit", r.unit},
                    {"passed", r.passed}});
  return list;
}

}  // namespace

nlohmann::ordered_json reportJson(const ReportData& data, const std::string& urdf_text,
                                  const ReportSize& size) {
  TimeTable times;
  Json metrics = Json::array(), phases = Json::array(), documents = Json::array();
  for (const ReportMetric& m : data.metrics)
    metrics.push_back(
        {{"section", m.section}, {"name", m.name}, {"value", m.value}, {"unit", m.unit}});
  for (const ReportPhase& p : data.phases)
    phases.push_back(
        {{"kind", toText(p.kind)}, {"start", p.start_s}, {"end", p.end_s}, {"label", p.label}});
  for (const ReportDocument& d : data.documents)
    documents.push_back({{"name", d.name}, {"text", d.text}});

  Json page = {{"format", kFormatVersion},
               {"title", data.title},
               {"subtitle", data.subtitle},
               {"passed", data.passed},
               {"verdict", data.verdict},
               {"start", data.start_s},
               {"end", data.end_s},
               {"headline", factsJson(data.headline)},
               {"requirements", requirementsJson(data.requirements)},
               {"metrics", std::move(metrics)},
               {"phases", std::move(phases)},
               {"groups", groupsJson(data, size.samples_per_series, times)},
               {"replay", nullptr},
               {"manifest", factsJson(data.manifest)},
               {"documents", std::move(documents)},
               {"tables", tablesJson(data.tables)},
               {"view", nullptr}};
  if (data.view) {
    page["view"] = {
        {"start", data.view->start_s}, {"end", data.view->end_s}, {"at", data.view->at_s}};
  }
  if (data.replay) page["replay"] = replayJson(*data.replay, urdf_text, size.replay_rate_Hz, times);
  page["times"] = times.json();
  return page;
}

}  // namespace ballbot
