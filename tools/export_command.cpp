#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cosim/log_reader.hpp"
#include "experiment/log_tables.hpp"
#include "experiment/recorded_run.hpp"
#include "experiment/run_folder.hpp"
#include "report/json_text.hpp"
#include "tools/commands.hpp"
#include "tools/table_export.hpp"

namespace ballbot {
namespace {

struct ExportArguments {
  std::string run, csv_folder, hdf5_file;
  bool json = false;
};

/// @throw InputError saying why there is nothing to export
void requireSomething(const RunLog& log, const RunFolder& run) {
  if (!log.empty()) return;
  std::string why = "is empty; the run was ended before anything was written";
  if (log.unknown > 0) {
    why = fmt::format(
        "holds nothing of a run, but events of other channels such as '{}'; is it this run's?",
        log.unknown_channel);
  } else if (!log.damage.none()) {
    why = log.damage.text();
  } else if (!log.digests.empty()) {
    why = "holds digests only; the scenario's 'recording' kept no messages";
  }
  throw InputError(fmt::format("{}: {}", run.logFile(), why));
}

ExitCode exportRun(const ExportArguments& a) {
  if (a.csv_folder.empty() && a.hdf5_file.empty()) {
    throw InputError("export: say what to write: --csv FOLDER, --hdf5 FILE, or both");
  }
  const RunFolder run = RunFolder::open(a.run);
  readManifest(run);  // whose log this is
  const RunLog log = readRecordedLog(run);
  requireSomething(log, run);
  const std::vector<LogTable> tables = logTables(log);
  std::vector<std::string> files;
  if (!a.csv_folder.empty()) files = exportCsv(tables, a.csv_folder);
  if (!a.hdf5_file.empty()) {
    exportHdf5(tables, a.hdf5_file);
    files.push_back(a.hdf5_file);
  }
  if (a.json) {
    nlohmann::ordered_json out;
    out["files"] = files;
    out["cut_off"] = log.cut_off;
    out["damaged"] = nullptr;
    if (!log.damage.none()) out["damaged"] = log.damage.text();
    for (const LogTable& t : tables) out["rows"][t.name] = t.rowCount();
    fmt::print("{}\n", jsonText(out));
  } else {
    for (const std::string& file : files) fmt::print("{}\n", file);
    if (log.cut_off) {
      fmt::print(stderr, "{}: the log ends in the middle of an event; all before it was exported\n",
                 a.run);
    }
  }
  if (log.damage.none()) return ExitCode::kPassed;
  fmt::print(stderr, "ballbot: {}: {}. What is readable was exported\n", run.logFile(),
             log.damage.text());
  return ExitCode::kBadInput;
}

}  // namespace

void addExportCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command =
      program.add_subcommand("export", "Write a run's recorded channels as CSV or HDF5");
  const auto a = std::make_shared<ExportArguments>();
  command->add_option("run", a->run, "Run folder")->required();
  command->add_option("--csv", a->csv_folder, "Folder for one CSV file per channel");
  command->add_option("--hdf5", a->hdf5_file,
                      "HDF5 file: a group per channel, units as attributes");
  command->add_flag("--json", a->json, "Print what was written as JSON");
  command->footer(
      "Example:\n  ballbot export runs/push-001 --csv /tmp/push --hdf5 /tmp/push.h5\n"
      "Exit codes: 0 written, 2 bad input, or the log is damaged (what is readable was written), 4 "
      "output\n"
      "could not be written.");
  command->callback([&result, a] { result = exportRun(*a); });
}

}  // namespace ballbot
