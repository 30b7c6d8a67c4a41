#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/json_text.hpp"
#include "tools/bench_record.hpp"

namespace ballbot {
namespace {

using RecordJson = nlohmann::ordered_json;

constexpr std::int64_t kCyclesBefore = 8, kCyclesAfter = 4, kFrameCyclesBefore = 1;

RecordJson readRecordJson(const std::string& folder) {
  const std::string path = folder + "/record.json";
  std::ifstream in(path);
  if (!in) {
    throw InputError(
        path +
        ": cannot be read; give the folder of a record, as `ballbot hil` named it when "
        "it stopped");
  }
  RecordJson j = RecordJson::parse(in, nullptr, false);
  if (j.is_discarded() || j.value("format", 0) != 1) {
    throw InputError(path + ": not the record of a bench as this version writes it (format 1)");
  }
  return j;
}

/// Cells of a line; a cell in double quotes, the last of decoded.csv, holds commas.
std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

using CsvRow = std::map<std::string, std::string>;

/// The rows of a table whose cycle is within these; none where the file is missing.
std::vector<CsvRow> rowsOf(const std::string& path, std::int64_t first, std::int64_t last) {
  std::ifstream in(path);
  std::string line;
  std::vector<CsvRow> rows;
  if (!std::getline(in, line)) return rows;
  const std::vector<std::string> names = cellsOf(line);
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.size() != names.size()) continue;  // where a disk was full
    CsvRow row;
    for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = cells[i];
    const long long cycle = std::atoll(row["cycle"].c_str());
    if (cycle >= first && cycle <= last) rows.push_back(std::move(row));
  }
  return rows;
}

std::string fromZero(const std::string& seconds, double zero) {
  return fmt::format("{:+.4f}", std::atof(seconds.c_str()) - zero);
}

void printCycles(const std::string& folder, std::int64_t middle, double zero, int drive) {
  const auto rows = rowsOf(folder + "/cycles.csv", middle - kCyclesBefore, middle + kCyclesAfter);
  if (rows.empty()) return;
  const std::string n = std::to_string(drive >= 0 && drive < kDriveCount ? drive + 1 : 1);
  fmt::print(
      "\ncycles around it, drive {}\n{:>9} {:>8} {:<9} {:<12} {:>6} {:>6} {:>9} {:>9} {:>10} "
      "{:>10}\n",
      n, "time [s]", "cycle", "state", "action", "status", "stale", "felt Nm", "sent Nm",
      "angle rad", "rad/s");
  for (CsvRow r : rows) {
    const auto number = [&](const char* name) { return std::atof(r[name + n].c_str()); };
    fmt::print("{:>9} {:>8} {:<9} {:<12} {:>6} {:>6} {:>9.4g} {:>9.4g} {:>10.4g} {:>10.4g}\n",
               fromZero(r["time_s"], zero), r["cycle"], r["state"], r["action"], r["status_" + n],
               r["stale_" + n], number("torque_Nm_"), number("sent_Nm_"), number("angle_rad_"),
               number("velocity_rad_per_s_"));
  }
}

void printFrames(const std::string& folder, std::int64_t middle, double zero) {
  const auto rows = rowsOf(folder + "/decoded.csv", middle - kFrameCyclesBefore, middle);
  if (!rows.empty()) fmt::print("\nframes of its cycle and of the one before\n");
  for (CsvRow r : rows) {
    fmt::print("{:>9} {:>8} bus {} {} {} {:<9} {:<12} {}\n", fromZero(r["time_s"], zero),
               r["cycle"], r["bus"], r["direction"], r["id"], r["who"], r["service"], r["meaning"]);
  }
}

}  // namespace

void showRecord(const std::string& folder, bool json) {
  const RecordJson j = readRecordJson(folder);
  if (json) {
    fmt::print("{}\n", jsonText(j));
    return;
  }
  const double zero = j["zero_s"];
  const RecordJson& first = j["first_check"];
  const std::int64_t cycles = j["cycles"]["count"];
  fmt::print("{} bench, {}, program {}: {} cycles of {:.4g} ms, {} frames\n",
             j["runner"].get<std::string>(), j["bench_file"].get<std::string>(),
             j["revision"].get<std::string>(), cycles, 1e3 * j["cycle_s"].get<double>(),
             j["frames"]["count"].get<std::int64_t>());
  fmt::print("ended: {} (exit code {})\ntorque: {}\n", j["ending"].get<std::string>(),
             j["exit_code"].get<int>(),
             j["torque_off"].get<bool>() ? "off, as every drive has said"
                                         : j["last_word"].get<std::string>());
  std::int64_t middle = 0;
  if (first.is_null()) {
    fmt::print("first check: none fired\n");
    middle = cycles == 0 ? 0 : std::llround(zero / j["cycle_s"].get<double>());
  } else {
    middle = first["cycle"];
    fmt::print("first check: {}, cycle {}, {:.6f} s: {}\n  then {}; {}\n",
               first["name"].get<std::string>(), middle, first["time_s"].get<double>(),
               first["text"].get<std::string>(), first["reaction"].get<std::string>(),
               first["page"].get<std::string>());
  }
  for (std::size_t i = first.is_null() ? 0 : 1; i < j["checks"].size(); ++i) {
    const RecordJson& c = j["checks"][i];
    fmt::print("later: {:+.4f} s, cycle {}: {}: {}\n", c["time_s"].get<double>() - zero,
               c["cycle"].get<std::int64_t>(), c["name"].get<std::string>(),
               c["text"].get<std::string>());
  }
  printCycles(folder, middle, zero, first.is_null() ? -1 : first["drive"].get<int>());
  printFrames(folder, middle, zero);
}

}  // namespace ballbot
