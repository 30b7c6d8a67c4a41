#include "tools/study_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/text_file.hpp"
#include "studies/setting_text.hpp"
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
  writeTextFile(folder.file("summary.json"), summary.dump(2) + "\n");
  writeTextFile(folder.file("report.html"), studyPage(study, engine, findings.boundaries));
  for (const StudyFigure& figure :
       studyFigures(study, arrange(study, engine.cases(), engine.results()))) {
    writeTextFile(folder.file(figure.file), figure.svg);
  }
  Json timing;
  timing["cases_run"] = engine.ranNow();
  timing["wall_s"] = findings.wall_s;
  timing["wall_in_runs_s"] = engine.wallSecondsNow();
  if (findings.jobs > 0 && findings.wall_s > 0) {
    timing["jobs"] = findings.jobs;
    timing["cases_per_minute_per_job"] =
        60 * static_cast<double>(engine.ranNow()) / findings.wall_s / findings.jobs;
    timing["share_of_time_in_runs"] = engine.wallSecondsNow() / (findings.wall_s * findings.jobs);
  }
  writeTextFile(folder.file("timing.json"), timing.dump(2) + "\n");
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
    for (const std::string& sentence :
         studyAnswer(study, arrange(study, engine.cases(), engine.results())))
      out += "  " + sentence + "\n";
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
