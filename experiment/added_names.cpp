#include "experiment/added_names.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiment/log_tables.hpp"

namespace ballbot {
namespace {

/// What the table holds of every run.
std::set<std::string> columnsOf(const std::string& table) {
  RunLog log;
  log.sensors.emplace_back();
  log.plans.emplace_back();
  const std::vector<LogTable> tables = logTables(log);
  std::set<std::string> out;
  for (const LogTable::Column& column : findTable(tables, table)->columns) {
    out.insert(column.name);
  }
  return out;
}

bool isName(const std::string& name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), allowed) &&
         !(name[0] >= '0' && name[0] <= '9');
}

}  // namespace

void requireNewNames(const std::vector<AddedSignal>& added, const std::string& table) {
  if (added.empty()) return;
  std::set<std::string> taken = columnsOf(table);
  for (const AddedSignal& signal : added) {
    if (!isName(signal.name)) {
      throw InputError(fmt::format(
          "'{}' is added to the table '{}' of a run: a name must be of letters, digits and _",
          signal.name, table));
    }
    if (!taken.insert(signal.name).second) {
      throw InputError(
          fmt::format("'{}' is added to the table '{}' of a run, which has such a column already; "
                      "give it a name of its own",
                      signal.name, table));
    }
  }
}

}  // namespace ballbot
