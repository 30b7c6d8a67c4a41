#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/printable_text.hpp"
#include "hil/record/record_sums.hpp"
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
  const bool is_record = j.is_object() && j.contains("format") && j["format"] == 1;
  if (!is_record) {
    throw InputError(path + ": not the record of a bench as this version writes it (format 1)");
  }
  return j;
}

/// Cells of a line. A cell in quotes may hold commas, and quotes that are doubled.
std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool doubled = quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
    if (doubled) {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
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

std::string cyclesText(const std::string& folder, std::int64_t middle, double zero, int drive) {
  const auto rows = rowsOf(folder + "/cycles.csv", middle - kCyclesBefore, middle + kCyclesAfter);
  if (rows.empty()) return "";
  const std::string n = std::to_string(drive >= 0 && drive < kDriveCount ? drive + 1 : 1);
  std::string text = fmt::format(
      "\ncycles around it, drive {}\n{:>9} {:>8} {:<9} {:<12} {:>6} {:>6} {:>9} {:>9} {:>10} "
      "{:>10}\n",
      n, "time [s]", "cycle", "state", "action", "status", "stale", "felt Nm", "sent Nm",
      "angle rad", "rad/s");
  for (CsvRow r : rows) {
    const auto number = [&](const char* name) { return std::atof(r[name + n].c_str()); };
    text +=
        fmt::format("{:>9} {:>8} {:<9} {:<12} {:>6} {:>6} {:>9.4g} {:>9.4g} {:>10.4g} {:>10.4g}\n",
                    fromZero(r["time_s"], zero), r["cycle"], r["state"], r["action"],
                    r["status_" + n], r["stale_" + n], number("torque_Nm_"), number("sent_Nm_"),
                    number("angle_rad_"), number("velocity_rad_per_s_"));
  }
  return text;
}

std::string framesText(const std::string& folder, std::int64_t middle, double zero) {
  const auto rows = rowsOf(folder + "/decoded.csv", middle - kFrameCyclesBefore, middle);
  std::string text = rows.empty() ? "" : "\nframes of its cycle and of the one before\n";
  for (CsvRow r : rows) {
    text += fmt::format("{:>9} {:>8} bus {} {} {} {:<9} {:<12} {}\n", fromZero(r["time_s"], zero),
                        r["cycle"], r["bus"], r["direction"], r["id"], r["who"], r["service"],
                        r["meaning"]);
  }
  return text;
}

std::string textOf(const RecordJson& j, const char* key) { return j.at(key).get<std::string>(); }

std::string checksText(const RecordJson& j, double zero) {
  const RecordJson& first = j.at("first_check");
  const bool any = !j.at("checks").empty();
  std::string text = any ? "first check: none stopped the bench\n" : "first check: none fired\n";
  if (!first.is_null()) {
    text = fmt::format("first check: {}, cycle {}, {:.6f} s: {}\n  then {}; {}\n",
                       textOf(first, "name"), first.at("cycle").get<std::int64_t>(),
                       first.at("time_s").get<double>(), textOf(first, "text"),
                       textOf(first, "reaction"), textOf(first, "page"));
  }
  for (std::size_t i = first.is_null() ? 0 : 1; i < j.at("checks").size(); ++i) {
    const RecordJson& c = j["checks"][i];
    text += fmt::format("{}: {:+.4f} s, cycle {}: {}: {}\n", first.is_null() ? "noticed" : "later",
                        c.at("time_s").get<double>() - zero, c.at("cycle").get<std::int64_t>(),
                        textOf(c, "name"), textOf(c, "text"));
  }
  return text;
}

std::string recordText(const std::string& folder, const RecordJson& j) {
  const double zero = j.at("zero_s");
  const std::int64_t middle = j.at("zero_cycle");
  const RecordJson& first = j.at("first_check");
  std::string text = fmt::format(
      "{} bench, {}, program {}: {} cycles of {:.4g} ms, {} frames\nended: {} (exit code {})\n"
      "torque: {}\n",
      textOf(j, "runner"), textOf(j, "bench_file"), textOf(j, "revision"),
      j.at("cycles").at("count").get<std::int64_t>(), 1e3 * j.at("cycle_s").get<double>(),
      j.at("frames").at("count").get<std::int64_t>(), textOf(j, "ending"),
      j.at("exit_code").get<int>(),
      j.at("torque_off").get<bool>() ? "off, as every drive has said" : textOf(j, "last_word"));
  text += checksText(j, zero);
  text += cyclesText(folder, middle, zero, first.is_null() ? -1 : first.at("drive").get<int>());
  return text + framesText(folder, middle, zero);
}

}  // namespace

void showRecord(const std::string& folder, bool json) {
  const RecordJson j = readRecordJson(folder);
  try {
    // Somebody else's record may hold anything.
    fmt::print("{}", json ? jsonText(j) + "\n" : printableText(recordText(folder, j)));
  } catch (const nlohmann::json::exception& e) {
    throw InputError(
        fmt::format("{}/record.json: not the record of a bench: {}", folder, e.what()));
  }
  const std::vector<std::string> damage = recordDamage(folder);
  if (!damage.empty()) {
    throw InputError(fmt::format("{}: DAMAGED, what is printed may not be what happened: {}",
                                 folder, fmt::join(damage, "; ")));
  }
}

}  // namespace ballbot
