#pragma once

#include <string>
#include <vector>

#include "controller/cost_terms.hpp"
#include "cosim/log_reader.hpp"

namespace ballbot {

/// One recorded channel as columns of numbers, for export and plots. The first column is time_s.
struct LogTable {
  struct Column {
    std::string name;  ///< e.g. "joint_torque_wheel1"
    std::string unit;  ///< e.g. "N m"; empty for counts
    std::vector<double> values;
  };
  std::string name;  ///< e.g. "truth"
  std::vector<Column> columns;

  std::size_t rowCount() const { return columns.empty() ? 0 : columns.front().values.size(); }
  /// @throw InputError if there is no such column.
  const std::vector<double>& column(const std::string& column_name) const;
};

/// Column of the table `plan` that holds a term of the cost.
std::string costColumn(CostTerm term);

/// All channels of a log that hold anything: sensors, truth, estimate, command, plan.
std::vector<LogTable> logTables(const RunLog& log);

/// The table of that name, or null.
const LogTable* findTable(const std::vector<LogTable>& tables, const std::string& name);

}  // namespace ballbot
