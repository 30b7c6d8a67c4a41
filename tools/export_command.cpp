#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cosim/log_reader.hpp"
#include "experiment/log_tables.hpp"
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

ExitCode exportRun(const ExportArguments& a) {
  if (a.csv_folder.empty() && a.hdf5_file.empty()) {
    throw InputError("export: say what to write: --csv FOLDER, --hdf5 FILE, or both");
  }
  const RunLog log = readRunLog(RunFolder::open(a.run).logFile());
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
    for (const LogTable& t : tables) out["rows"][t.name] = t.rowCount();
    fmt::print("{}\n", jsonText(out));
  } else {
    for (const std::string& file : files) fmt::print("{}\n", file);
    if (log.cut_off) fmt::print(stderr, "{}: the log ends in the middle of an event; all before it was exported\n", a.run);
  }
  return ExitCode::kPassed;
}

}  // namespace

void addExportCommand(CLI::App& program, ExitCode& result) {
  CLI::App* command = program.add_subcommand("export", "Write a run's recorded channels as CSV or HDF5");
  const auto a = std::make_shared<ExportArguments>();
  command->add_option("run", a->run, "Run folder")->required();
  command->add_option("--csv", a->csv_folder, "Folder for one CSV file per channel");
  command->add_option("--hdf5", a->hdf5_file, "HDF5 file: a group per channel, units as attributes");
  command->add_flag("--json", a->json, "Print what was written as JSON");
  command->footer(
      "Example:\n  ballbot export runs/push-001 --csv /tmp/push --hdf5 /tmp/push.h5\n"
      "Exit codes: 0 written, 2 bad input, 4 output could not be written.");
  command->callback([&result, a] { result = exportRun(*a); });
}

}  // namespace ballbot
