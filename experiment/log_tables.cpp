#include "experiment/log_tables.hpp"

#include <algorithm>

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
  addTable("truth", log.truth, tables);
  addTable("estimate", log.estimates, tables);
  addTable("command", log.commands, tables);
  addTable("plan", log.plans, tables);
  return tables;
}

const LogTable* findTable(const std::vector<LogTable>& tables, const std::string& name) {
  const auto it =
      std::find_if(tables.begin(), tables.end(), [&](const LogTable& t) { return t.name == name; });
  return it == tables.end() ? nullptr : &*it;
}

}  // namespace ballbot
