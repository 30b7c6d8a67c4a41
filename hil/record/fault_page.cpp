#include "hil/record/fault_page.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "hil/record/fault_plots.hpp"
#include "hil/record/frame_words.hpp"
#include "hil/record/record_json.hpp"
#include "hil/record/troubleshooting_pages.hpp"

namespace ballbot {
namespace {

constexpr double kShownBefore_s = 0.6, kShownAfter_s = 0.6;  // as the page is opened
constexpr std::int64_t kFramesBefore = 3, kFramesAfter = 2;  // cycles

std::string secondsText(double t) { return fmt::format("{:+.4f}", t); }

ReportTable checksTable(const FaultRecord& record) {
  ReportTable table;
  table.title = "Which check fired first, and what followed";
  table.caption =
      "A check that fires after the first one often tells of the stop itself. Times are seconds "
      "from the first check, in all of the page; a check that fired in many cycles stands where it "
      "fired for the first time.";
  table.columns = {"", "time [s]", "cycle", "check", "what it says", "in cycles", "to read on"};
  table.first = true;
  int number = 0;
  for (const RecordedCheck& c : record.recorder.checks()) {
    const bool first = record.hasFault() && number == 0;
    const Check& check = checkOf(c.finding.fault);
    table.rows.push_back(
        {{first ? "first" : std::to_string(number + 1), secondsText(record.seconds(c.time_ns)),
          std::to_string(c.cycle), check.name, record.bench.textOf(c.finding),
          std::to_string(c.cycles), check.page},
         first});
    ++number;
  }
  return table;
}

ReportTable framesTable(const FaultRecord& record) {
  const std::int64_t middle = record.zeroCycle();
  ReportTable table;
  table.title = "Frames on the buses";
  table.caption = fmt::format(
      "Cycles {} to {}, {}; the cycle of the decision "
      "stands out. All other frames of the record: decoded.csv beside this page.",
      middle - kFramesBefore, middle + kFramesAfter,
      record.recorder.hasClock()
          ? "in the order in which they passed the bench"
          : "each bus by bus, because a stepped bench knows no time within one");
  table.columns = {"time [s]", "cycle", "bus", "way", "id", "whose", "what", "in words"};
  for (const RecordedFrame* f : record.frames()) {
    if (f->cycle < middle - kFramesBefore || f->cycle > middle + kFramesAfter) continue;
    const FrameWords w = wordsOf(*f, record.config());
    table.rows.push_back({{secondsText(record.seconds(f->time_ns)), std::to_string(f->cycle),
                           std::to_string(f->bus), f->sent ? "sent" : "came",
                           fmt::format("{:03X}", f->frame.id), w.who, w.service, w.meaning},
                          f->cycle == middle});
  }
  return table;
}

/// A mark for each moment in which checks fired for the first time.
std::vector<ReportPhase> marks(const FaultRecord& record) {
  std::vector<ReportPhase> list;
  for (const RecordedCheck& c : record.recorder.checks()) {
    const double t = record.seconds(c.time_ns);
    const std::string name = checkOf(c.finding.fault).name;
    if (!list.empty() && list.back().start_s == t) {
      if (list.back().label.find(name) == std::string::npos) list.back().label += ", " + name;
      continue;
    }
    const bool first = list.empty() && record.hasFault();
    list.push_back({ReportPhase::Kind::kFault, t, t, first ? "first: " + name : name});
  }
  return list;
}

void fillHeader(ReportData& page, const FaultRecord& record) {
  page.passed = !record.hasFault() && record.facts.exit_code == 0;
  page.subtitle = fmt::format("{} bench, cycle {} of {:.4g} ms", record.facts.runner,
                              record.zeroCycle(), 1e3 * record.config().cycleSeconds());
  if (record.hasFault()) {
    const Check& check = checkOf(record.recorder.first().finding.fault);
    page.title = "Stopped: " + record.bench.faultText();
    page.verdict = fmt::format("First check: {}", check.name);
    if (troubleshootingPage(check.page) != nullptr) {
      page.documents.push_back({check.page, troubleshootingPage(check.page)});
      page.headline.push_back({"what to do", check.page, check.page});
    }
  } else {
    page.title = "No check fired";
    page.verdict = record.facts.ending;
  }
  page.headline.push_back(
      {"torque", record.bench.torqueIsOff() ? "off, as every drive has said" : "MAY BE ON"});
  const auto& cycles = record.recorder.cycles();
  page.headline.push_back({"recorded", fmt::format("{} cycles, {} frames", cycles.size(),
                                                   record.recorder.frames().size())});
}

void fillManifest(ReportData& page, const FaultRecord& record) {
  const RunFacts& f = record.facts;
  std::string overrides;
  for (const std::string& text : f.overrides) overrides += (overrides.empty() ? "" : ", ") + text;
  page.manifest = {
      {"bench", f.bench_file},
      {"changed", overrides.empty() ? "nothing" : overrides},
      {"runner", f.runner},
      {"ended", f.ending},
      {"exit code", std::to_string(f.exit_code)},
      {"bus time of 0 s", fmt::format("{:.6f} s", 1e-9 * static_cast<double>(record.zeroNs()))},
      {"digest of the bench file", f.bench_digest},
      {"digest of the scenario", f.config_digest},
      {"program", f.version + ", " + f.revision}};
  if (!record.bench.lastWord().empty()) {
    page.manifest.push_back({"last word", record.bench.lastWord()});
  }
}

}  // namespace

ReportData faultPage(const FaultRecord& record) {
  ReportData page;
  fillHeader(page, record);
  fillManifest(page, record);
  if (!record.recorder.checks().empty()) page.tables.push_back(checksTable(record));
  page.tables.push_back(framesTable(record));
  page.phases = marks(record);
  page.groups = faultPlots(record);
  page.groups.insert(page.groups.begin(), faultLanes(record));
  const auto& cycles = record.recorder.cycles();
  const double period = record.config().cycleSeconds();
  page.start_s = cycles.empty() ? -period : record.seconds(cycles[0].time_ns);
  page.end_s = period + (cycles.empty() ? 0 : record.seconds(cycles[cycles.size() - 1].time_ns));
  // What fired before the record began has no place on its axis.
  page.phases.erase(std::remove_if(page.phases.begin(), page.phases.end(),
                                   [&](const auto& p) { return p.start_s < page.start_s; }),
                    page.phases.end());
  page.view =
      ReportView{std::max(page.start_s, -kShownBefore_s), std::min(page.end_s, kShownAfter_s), 0};
  return page;
}

}  // namespace ballbot
