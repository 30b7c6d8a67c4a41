#include "tools/study_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "core/error.hpp"
#include "experiment/text_file.hpp"
#include "report/json_text.hpp"
#include "studies/setting_text.hpp"
#include "studies/shell_command.hpp"
#include "studies/study_answer.hpp"
#include "studies/study_figures.hpp"
#include "studies/study_report.hpp"
#include "tools/hdf5_file.hpp"

namespace ballbot {
namespace {

using Json = nlohmann::ordered_json;

// The terminal names that many cases that did not run; the table has all.
constexpr int kFailuresShown = 5;

std::string commandsScript(const Study& study, const StudyEngine& engine) {
  std::string out = "# Every case alone, from the folder where the study was started:\n";
  for (const StudyCase& c : engine.cases()) {
    out += fmt::format("\n# case {}: {}; {}\n{}\n", c.id, c.describe(study),
                       toText(engine.result(c).outcome), commandLine(c.command(study.scenario)));
  }
  return out;
}

void writeHdf5(const ResultTable& table, const std::string& path) {
  Hdf5File file(path);
  file.beginGroup("cases");
  for (const ResultTable::Column& column : table.columns) {
    if (column.isText()) {
      file.addTexts(column.name, column.words);
    } else {
      file.addNumbers(column.name, column.numbers, column.unit);
    }
  }
  file.finish();
}

/// Processor time of this process or of its children that have ended [s].
double processorSeconds(int who) {
  rusage usage{};
  ::getrusage(who, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Each as SVG and, where librsvg's converter is installed, as PDF.
void writeFigures(const std::vector<StudyFigure>& figures, const StudyFolder& folder) {
  for (const StudyFigure& figure : figures) {
    writeTextFile(folder.file(figure.file + ".svg"), figure.svg);
  }
  for (const StudyFigure& figure : figures) {
    const std::string pdf = folder.file(figure.file + ".pdf");
    // The date stands in the file; the same study shall give the same bytes.
    const CommandEnd end = runCommand({"env", "SOURCE_DATE_EPOCH=0", "rsvg-convert", "--format=pdf",
                                       "--output", pdf, folder.file(figure.file + ".svg")});
    if (end.exit_code == 127) {
      fmt::print(stderr, "no PDF figures: rsvg-convert is not here (Debian: librsvg2-bin)\n");
      return;
    }
    if (end.exit_code != 0) throw OutputError(fmt::format("{}: {}", pdf, end.err));
  }
}

std::string placeText(const Study& study, const PlaceBoundary& b) {
  std::string out;
  for (std::size_t a = 0; a < b.place.size(); ++a) {
    if (b.place[a].label.empty()) continue;
    const std::string& unit = study.axes[a].unit;
    out += fmt::format("{}{} {}{}{}", out.empty() ? "" : ", ", study.axes[a].name, b.place[a].label,
                       unit.empty() ? "" : " ", unit);
  }
  return out.empty() ? study.name : out;
}

Json boundaryJson(const Study& study, const PlaceBoundary& b) {
  Json j;
  for (std::size_t a = 0; a < b.place.size(); ++a) {
    if (!b.place[a].label.empty()) j["place"][study.axes[a].name] = b.place[a].label;
  }
  const Boundary& found = b.boundary;
  j["found"] = found.kind == Boundary::Kind::kFound;
  if (found.kind == Boundary::Kind::kFound) {
    j["passes"] = found.rising ? "above" : "below";
    j["estimate"] = found.estimate;
    j["low"] = found.low ? Json(*found.low) : Json();
    j["high"] = found.high ? Json(*found.high) : Json();
  }
  j["text"] = toText(found, study.search->rate, study.axis(study.search->axis).unit);
  return j;
}

}  // namespace

int failedCases(const StudyEngine& engine) {
  return engine.count(CaseOutcome::kError) + engine.count(CaseOutcome::kCrashed) +
         engine.count(CaseOutcome::kTimedOut);
}

Json studySummary(const Study& study, const StudyEngine& engine, const StudyFolder& folder,
                  const StudyFindings& findings) {
  Json j;
  j["study"] = study.name;
  j["cases"] = engine.cases().size();
  j["failed"] = failedCases(engine);
  for (const CaseOutcome outcome :
       {CaseOutcome::kPassed, CaseOutcome::kMissed, CaseOutcome::kFell, CaseOutcome::kError,
        CaseOutcome::kCrashed, CaseOutcome::kTimedOut}) {
    j["outcomes"][toText(outcome)] = engine.count(outcome);
  }
  j["table_digest"] = engine.table().digest();
  if (study.search) {
    j["search"] = {{"axis", study.search->axis}, {"rate", study.search->rate}};
    for (const PlaceBoundary& b : findings.boundaries)
      j["boundaries"].push_back(boundaryJson(study, b));
  }
  j["study_folder"] = folder.path();
  return j;
}

void writeStudyOutput(const Study& study, const StudyEngine& engine, const StudyFolder& folder,
                      const StudyFindings& findings) {
  const ResultTable table = engine.table();
  writeTextFile(folder.file("table.csv"), table.csv());
  writeHdf5(table, folder.file("table.h5"));
  writeTextFile(folder.file("commands.sh"), commandsScript(study, engine));
  Json summary = studySummary(study, engine, folder, findings);
  summary.erase("study_folder");  // the same study gives the same file wherever it lies
  writeTextFile(folder.file("summary.json"), jsonText(summary) + "\n");
  writeTextFile(folder.file("report.html"), studyPage(study, engine, findings.boundaries));
  writeFigures(studyFigures(study, arrange(study, engine.cases(), engine.results())), folder);
  Json timing;
  timing["cases_run"] = engine.ranNow();
  timing["wall_s"] = findings.wall_s;
  if (findings.jobs > 0 && findings.wall_s > 0) {
    const double cpu_s = processorSeconds(RUSAGE_SELF) + processorSeconds(RUSAGE_CHILDREN);
    timing["jobs"] = findings.jobs;
    timing["cases_per_minute"] = 60 * static_cast<double>(engine.ranNow()) / findings.wall_s;
    timing["cpu_s"] = cpu_s;
    timing["cases_per_minute_per_core"] = 60 * static_cast<double>(engine.ranNow()) / cpu_s;
    timing["share_of_cpu_in_runs"] = engine.cpuSecondsNow() / cpu_s;
  }
  writeTextFile(folder.file("timing.json"), jsonText(timing) + "\n");
}

std::string studyText(const Study& study, const StudyEngine& engine, const StudyFolder& folder,
                      const StudyFindings& findings) {
  std::string out = fmt::format(
      "{}: {} cases: {} passed, {} missed a requirement, {} fell, {} did not run\n", study.name,
      engine.cases().size(), engine.count(CaseOutcome::kPassed), engine.count(CaseOutcome::kMissed),
      engine.count(CaseOutcome::kFell), failedCases(engine));
  int shown = 0;
  for (const StudyCase& c : engine.cases()) {
    const CaseResult& r = engine.result(c);
    if (ran(r.outcome) || ++shown > kFailuresShown) continue;
    out += fmt::format("  {} ({}): {}: {}\n    {}\n", c.id, c.describe(study), toText(r.outcome),
                       r.reason, commandLine(c.command(study.scenario)));
  }
  if (!study.search) {
    const StudyView view = arrange(study, engine.cases(), engine.results());
    for (const std::string& sentence : studyAnswer(study, view)) out += "  " + sentence + "\n";
    for (const std::string& sentence : studyComparison(study, view)) out += "  " + sentence + "\n";
    for (const std::string& sentence : studyMetrics(study, view)) out += "  " + sentence + "\n";
  }
  for (const PlaceBoundary& b : findings.boundaries) {
    out += fmt::format("  {}: {}\n", placeText(study, b),
                       toText(b.boundary, study.search->rate, study.axis(study.search->axis).unit));
  }
  out += fmt::format(
      "  {:<16} {}\n  {:<16} {}/table.csv, table.h5\n  {:<16} {}/commands.sh\n  {:<16} "
      "{}/report.html\n",
      "table digest", engine.table().digest(), "table", folder.path(), "each case alone",
      folder.path(), "report", folder.path());
  return out;
}

}  // namespace ballbot
