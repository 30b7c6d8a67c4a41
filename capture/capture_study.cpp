#include "capture/capture_study.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include "core/angle.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/yaml_file.hpp"
#include "studies/setting_text.hpp"

namespace ballbot {
namespace {

/// What a capture decides itself.
constexpr const char* kDecided[] = {"duration_s", "requirements", "seed", "environment.pushes"};

/// A quoted YAML scalar.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "''" : std::string(1, c);
  return out + "'";
}

/// Exactly zero where it would be all but zero, and without a sign.
std::string share(double cosine_or_sine) {
  return numberText(std::round(1e12 * cosine_or_sine) / 1e12 + 0.0);
}

std::string list(const std::vector<double>& values) {
  std::string out;
  for (const double v : values) out += (out.empty() ? "" : ", ") + numberText(v);
  return "[" + out + "]";
}

void requireUndecided(const std::string& override_text) {
  const std::string path = readOverride(override_text).first;
  for (const std::string decided : kDecided) {
    if (path != decided && path.rfind(decided + ".", 0) != 0) continue;
    throw InputError(fmt::format(
        "{}: {} is what a capture decides itself: it has one push, and only a fall counts",
        override_text, decided));
  }
}

/// path=value of each, as the entries of a mapping.
std::string settings(const std::vector<std::string>& overrides) {
  std::string out;
  for (const std::string& text : overrides) {
    requireUndecided(text);
    const auto [path, value] = readOverride(text);
    out += fmt::format("{}{}: {}", out.empty() ? "" : ", ", quoted(path), toFlowYaml(value));
  }
  return "{" + out + "}";
}

std::string directionOption(double deg) {
  const double a = kRadPerDeg * deg;
  return fmt::format(
      "      - {{label: '{}', set: {{environment.pushes.0.force_N: [{{from: force, times: {}}}, "
      "{{from: force, times: {}}}, 0]}}}}\n",
      numberText(deg), share(std::cos(a)), share(std::sin(a)));
}

}  // namespace

CaptureVariant CaptureVariant::of(const std::string& text) {
  CaptureVariant out;
  std::stringstream parts(text);
  std::string part;
  while (std::getline(parts, part, ';')) {
    const auto first = part.find_first_not_of(' ');
    if (first == std::string::npos) continue;
    out.overrides.push_back(part.substr(first, part.find_last_not_of(' ') + 1 - first));
    readOverride(out.overrides.back());
    out.label += (out.label.empty() ? "" : "; ") + out.overrides.back();
  }
  if (out.overrides.empty()) {
    throw InputError(fmt::format(
        "'{}' changes nothing: write path=value, more of them with ';' between them", text));
  }
  return out;
}

Study captureStudy(const CaptureRequest& r, double up_to_N) {
  const double longest = *std::max_element(r.durations_s.begin(), r.durations_s.end());
  std::string text = fmt::format(
      "name: {}\n"
      "summary: 'Which pushes on the base are survived, by direction'\n"
      "scenario: {}\n"
      "set:\n"
      "  duration_s: {}\n"
      "  requirements: {{fell: {{below: 1}}}}\n"
      "  environment.pushes: [{{body: base, point_m: [0, 0, 0], force_N: [0, 0, 0], start_s: {}, "
      "duration_s: {}}}]\n",
      quoted("capture_" + std::filesystem::path(r.scenario).stem().string()), quoted(r.scenario),
      numberText(r.start_s + longest + r.after_s), numberText(r.start_s), numberText(longest));
  for (const std::string& override_text : r.overrides) {
    requireUndecided(override_text);
    const auto [path, value] = readOverride(override_text);
    text += fmt::format("  {}: {}\n", quoted(path), toFlowYaml(value));
  }
  text += "axes:\n  - name: variant\n    options:\n";
  for (const CaptureVariant& v : r.variants) {
    text += fmt::format("      - {{label: {}, set: {}}}\n", quoted(v.label), settings(v.overrides));
  }
  text += fmt::format(
      "  - {{name: duration, unit: s, paths: environment.pushes.0.duration_s, values: {}}}\n"
      "  - {{name: height, unit: m, paths: environment.pushes.0.point_m.2, values: {}}}\n"
      "  - name: direction\n    unit: deg\n    options:\n",
      list(r.durations_s), list(r.heights_m));
  for (int i = 0; i < r.directions; ++i) text += directionOption(r.directionDeg(i));
  // An axis needs a path of its own; its value gets to the others through `from`. The push is
  // level.
  text += fmt::format(
      "  - {{name: force, unit: N, paths: [{{path: environment.pushes.0.force_N.2, times: 0}}], "
      "range: [0, {}]}}\n"
      "seeds: {}\n"
      "timeout_s: {}\n"
      "search: {{axis: force, rate: {}, resolution: {}}}\n"
      "report: {{along: force, curves: direction, rate: {}}}\n",
      numberText(up_to_N), r.seeds, numberText(r.timeout_s), numberText(r.rate),
      numberText(std::clamp(r.resolution_N / up_to_N, 1e-4, 1.0)), numberText(r.rate));
  return readStudy(parseYaml(text, "capture"), "capture");
}

}  // namespace ballbot
