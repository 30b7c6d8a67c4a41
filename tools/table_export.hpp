#pragma once

#include <string>
#include <vector>

#include "experiment/log_tables.hpp"

namespace ballbot {

/// One CSV file per table in `folder`; the header line has names with units, numbers round-trip.
/// @throw OutputError
std::vector<std::string> exportCsv(const std::vector<LogTable>& tables, const std::string& folder);

/// One HDF5 file: a group per table, a dataset per column with its unit as attribute `unit`.
/// @throw OutputError
void exportHdf5(const std::vector<LogTable>& tables, const std::string& path);

}  // namespace ballbot
