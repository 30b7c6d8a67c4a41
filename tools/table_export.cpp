#include "tools/table_export.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiment/text_file.hpp"
#include "tools/hdf5_file.hpp"

namespace ballbot {

std::vector<std::string> exportCsv(const std::vector<LogTable>& tables, const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw OutputError(fmt::format("{}: cannot be created: {}", folder, failed.message()));
  std::vector<std::string> files;
  for (const LogTable& table : tables) {
    fmt::memory_buffer out;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const LogTable::Column& column = table.columns[c];
      fmt::format_to(std::back_inserter(out), "{}{}{}", c ? "," : "", column.name,
                     column.unit.empty() || c == 0 ? "" : fmt::format(" [{}]", column.unit));
    }
    out.push_back('\n');
    for (std::size_t row = 0; row < table.rowCount(); ++row) {
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        fmt::format_to(std::back_inserter(out), "{}{}", c ? "," : "", table.columns[c].values[row]);
      }
      out.push_back('\n');
    }
    files.push_back(folder + "/" + table.name + ".csv");
    writeTextFile(files.back(), fmt::to_string(out));
  }
  return files;
}

void exportHdf5(const std::vector<LogTable>& tables, const std::string& path) {
  Hdf5File file(path);
  for (const LogTable& table : tables) {
    file.beginGroup(table.name);
    for (const LogTable::Column& column : table.columns)
      file.addNumbers(column.name, column.values, column.unit);
  }
  file.finish();
}

}  // namespace ballbot
