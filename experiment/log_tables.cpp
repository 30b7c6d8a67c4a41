#include "experiment/log_tables.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "controller/cost_terms.hpp"
#include "core/error.hpp"
#include "core/number_text.hpp"
#include "model/signal_table.hpp"

namespace ballbot {
namespace {

SimTime timeOf(const RecordedCommand& c) { return c.time; }
const ActuatorCommand& frameOf(const RecordedCommand& c) { return c.command; }
template <typename Frame>
SimTime timeOf(const Frame& frame) {
  return frame.time;
}
template <typename Frame>
const Frame& frameOf(const Frame& frame) {
  return frame;
}

/// Every element of every signal as a column.
template <typename Recorded>
void addTable(const char* name, const std::vector<Recorded>& recorded, std::vector<LogTable>& out) {
  if (recorded.empty()) return;
  const auto& signals = signalsOf(frameOf(recorded.front()));
  LogTable table{name, {{"time_s", "s", {}}}};
  for (const auto& signal : signals) {
    for (int i = 0; i < signal.size; ++i) {
      const bool term = std::string(signal.name) == "cost_terms";
      table.columns.push_back(
          {term ? costColumn(CostTerm(i)) : columnName(signal, i), signal.unit, {}});
    }
  }
  for (LogTable::Column& column : table.columns) column.values.reserve(recorded.size());
  std::vector<double> row(rowSize(signals));
  for (const Recorded& r : recorded) {
    readSignals(signals, frameOf(r), row.data());
    table.columns[0].values.push_back(decimalSeconds(toNs(timeOf(r))));
    for (std::size_t i = 0; i < row.size(); ++i) table.columns[i + 1].values.push_back(row[i]);
  }
  out.push_back(std::move(table));
}

/// What was added to the frames of a table, beside their own columns; not a number where a row has
/// none of it.
void addColumns(const AddedRecord& record, LogTable& table) {
  const std::vector<double> times = table.columns.front().values;  // the list below grows
  for (std::size_t i = 0; i < record.list.size(); ++i) {
    LogTable::Column column{record.list[i].name, record.list[i].unit, {}};
    column.values.reserve(times.size());
    std::size_t next = 0;
    for (const double time : times) {
      while (next < record.times.size() && decimalSeconds(toNs(record.times[next])) < time) ++next;
      const bool there =
          next < record.times.size() && decimalSeconds(toNs(record.times[next])) == time;
      column.values.push_back(there ? record.rows[next][i]
                                    : std::numeric_limits<double>::quiet_NaN());
    }
    table.columns.push_back(std::move(column));
  }
}

}  // namespace

const std::vector<double>& LogTable::column(const std::string& column_name) const {
  for (const Column& c : columns) {
    if (c.name == column_name) return c.values;
  }
  throw InputError(fmt::format("table '{}' has no column '{}'", name, column_name));
}

std::string costColumn(CostTerm term) { return std::string("cost_") + costTermName(term); }

std::vector<LogTable> logTables(const RunLog& log) {
  std::vector<LogTable> tables;
  addTable("sensors", log.sensors, tables);
  if (!log.sensors.empty()) addColumns(log.added[AddedTo::kSensors], tables.back());
  addTable("truth", log.truth, tables);
  if (!log.truth.empty()) addColumns(log.added[AddedTo::kTruth], tables.back());
  addTable("estimate", log.estimates, tables);
  if (!log.estimates.empty()) addColumns(log.added[AddedTo::kEstimate], tables.back());
  addTable("command", log.commands, tables);
  addTable("plan", log.plans, tables);
  if (!log.plans.empty()) addColumns(log.added[AddedTo::kPlan], tables.back());
  return tables;
}

const LogTable* findTable(const std::vector<LogTable>& tables, const std::string& name) {
  const auto it =
      std::find_if(tables.begin(), tables.end(), [&](const LogTable& t) { return t.name == name; });
  return it == tables.end() ? nullptr : &*it;
}

}  // namespace ballbot
