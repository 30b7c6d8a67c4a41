#include "tools/capture_output.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace ballbot {
namespace {

using Json = nlohmann::ordered_json;

const CaptureBound& boundAt(const CaptureFindings& f, std::size_t variant, std::size_t duration,
                            std::size_t height) {
  return f.bounds[(variant * f.request.durations_s.size() + duration) * f.request.heights_m.size() +
                  height];
}

/// Where a direction of the request stands among the bound's angles.
std::size_t angleOf(const CaptureFindings& f, int direction) {
  return static_cast<std::size_t>(direction * f.bound_request.per_direction);
}

const CaptureEdge* edgeAt(const CaptureFindings& f, std::size_t variant, std::size_t duration,
                          std::size_t height, int direction) {
  for (const CaptureEdge& e : f.edges) {
    if (e.variant == variant && e.duration == duration && e.height == height &&
        e.direction == direction)
      return &e;
  }
  return nullptr;
}

Json orNull(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json rowJson(const CaptureFindings& f, std::size_t v, std::size_t d, std::size_t h, int direction) {
  Json row;
  row["variant"] = f.request.variants[v].label;
  row["duration_s"] = f.request.durations_s[d];
  row["height_m"] = f.request.heights_m[h];
  row["direction_deg"] = f.request.directionDeg(direction);
  const CaptureEdge* e = edgeAt(f, v, d, h, direction);
  if (e) {
    row["survived_N"] = orNull(e->survived_N);
    row["fallen_N"] = orNull(e->fallen_N);
    row["low_N"] = orNull(e->boundary.low);
    row["high_N"] = orNull(e->boundary.high);
  }
  const CaptureBound& b = boundAt(f, v, d, h);
  const double known_N = b.known_N[angleOf(f, direction)];
  row["bound_known_N"] = known_N;
  row["bound_blind_N"] = b.blind_N[angleOf(f, direction)];
  if (e && e->survived_N) row["share_of_bound"] = *e->survived_N / known_N;
  return row;
}

/// "60", "60 (56 to 62)", "at least 110", "falls unpushed", "unknown".
std::string cell(const CaptureEdge& e) {
  if (e.boundary.kind == Boundary::Kind::kUnknown) return "unknown";
  if (!e.survived_N) return "falls unpushed";
  if (!e.fallen_N) return fmt::format("at least {:g}", *e.survived_N);
  std::string out = fmt::format("{:g}", *e.survived_N);
  if (e.boundary.low && e.boundary.high) {
    out += fmt::format(" ({:g} to {:g})", *e.boundary.low, *e.boundary.high);
  }
  return out;
}

/// One column of the table, its head first.
using Column = std::vector<std::string>;

void addBoundColumns(const CaptureFindings& f, std::size_t d, std::size_t h,
                     std::vector<Column>& columns) {
  for (std::size_t v = 0; v < f.request.variants.size(); ++v) {
    const CaptureBound& b = boundAt(f, v, d, h);
    bool shown = false;
    for (std::size_t w = 0; w < v; ++w) shown = shown || boundAt(f, w, d, h).known_N == b.known_N;
    if (shown) continue;
    const std::string of = v == 0 ? "" : " with " + f.request.variants[v].label;
    Column known = {"bound, N" + of};
    Column blind = {fmt::format("blind for {:g} ms, N{}", 1e3 * f.bound_request.blind_s, of)};
    for (int i = 0; i < f.request.directions; ++i) {
      known.push_back(fmt::format("{:.1f}", b.known_N[angleOf(f, i)]));
      blind.push_back(fmt::format("{:.1f}", b.blind_N[angleOf(f, i)]));
    }
    columns.push_back(known);
    columns.push_back(blind);
  }
}

std::string tableText(const CaptureFindings& f, std::size_t d, std::size_t h) {
  std::vector<Column> columns = {{"direction, deg"}};
  for (int i = 0; i < f.request.directions; ++i) {
    columns[0].push_back(fmt::format("{:g}", f.request.directionDeg(i)));
  }
  for (std::size_t v = 0; v < f.request.variants.size() && !f.edges.empty(); ++v) {
    columns.push_back({f.request.variants[v].label + ", N"});
    for (int i = 0; i < f.request.directions; ++i) {
      columns.back().push_back(cell(*edgeAt(f, v, d, h, i)));
    }
  }
  addBoundColumns(f, d, h, columns);
  std::string out;
  for (std::size_t row = 0; row < columns[0].size(); ++row) {
    for (const Column& c : columns) {
      std::size_t width = 0;
      for (const std::string& text : c) width = std::max(width, text.size());
      out += fmt::format("  {:>{}}", c[row], width);
    }
    out += "\n";
  }
  return out;
}

}  // namespace

Json captureJson(const CaptureFindings& f) {
  const CaptureRequest& r = f.request;
  Json j;
  j["scenario"] = r.scenario;
  j["directions"] = r.directions;
  j["start_s"] = r.start_s;
  j["after_s"] = r.after_s;
  j["bound"] = {{"blind_ms", 1e3 * f.bound_request.blind_s},
                {"tilt_limit_deg", f.bound_request.tilt_limit_deg}};
  if (!f.edges.empty()) {
    j["seeds"] = r.seeds;
    j["rate"] = r.rate;
    j["resolution_N"] = r.resolution_N;
  }
  j["pushes"] = Json::array();
  for (std::size_t v = 0; v < r.variants.size(); ++v) {
    for (std::size_t d = 0; d < r.durations_s.size(); ++d) {
      for (std::size_t h = 0; h < r.heights_m.size(); ++h) {
        for (int i = 0; i < r.directions; ++i) j["pushes"].push_back(rowJson(f, v, d, h, i));
      }
    }
  }
  return j;
}

std::string captureText(const CaptureFindings& f) {
  const CaptureRequest& r = f.request;
  std::string out;
  for (std::size_t d = 0; d < r.durations_s.size(); ++d) {
    for (std::size_t h = 0; h < r.heights_m.size(); ++h) {
      out += fmt::format("push of {:g} s at {:g} m above the ball's centre", r.durations_s[d],
                         r.heights_m[h]);
      if (!f.edges.empty()) {
        out += fmt::format("; largest survived by at least {:g} % of {} seed{}, to {:g} N",
                           100 * r.rate, r.seeds, r.seeds == 1 ? "" : "s", r.resolution_N);
      }
      out += "\n";
      out += tableText(f, d, h);
    }
  }
  out +=
      "  bound: no torque of the wheels gets the robot with its arm held still past it, to first "
      "order;\n"
      "  a swinging arm, large angles and wheels that the push drives beyond their limit are not "
      "in "
      "it\n";
  return out;
}

}  // namespace ballbot
