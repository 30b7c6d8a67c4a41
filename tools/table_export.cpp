#include "tools/table_export.hpp"

#include <hdf5.h>

#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiment/text_file.hpp"

namespace ballbot {
namespace {

/// An HDF5 handle that closes itself; a negative one is the library's way to say it failed.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw OutputError(what + ": HDF5 could not write it. Is the disk full?");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

void writeUnit(hid_t dataset, const std::string& unit, const std::string& what) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, what);
  H5Tset_size(type, unit.size());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, what);
  const Handle attribute(H5Acreate2(dataset, "unit", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, what);
  H5Awrite(attribute, type, unit.data());
}

void writeColumn(hid_t group, const LogTable::Column& column, const std::string& what) {
  const hsize_t size = column.values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, what);
  const Handle dataset(H5Dcreate2(group, column.name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT,
                                  H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose, what);
  if (H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()) < 0) {
    throw OutputError(what + ": HDF5 could not write it. Is the disk full?");
  }
  writeUnit(dataset, column.unit.empty() ? "1" : column.unit, what);
}

}  // namespace

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
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are said once, by us
  const Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, path);
  for (const LogTable& table : tables) {
    const Handle group(H5Gcreate2(file, table.name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, path);
    for (const LogTable::Column& column : table.columns) writeColumn(group, column, path);
  }
}

}  // namespace ballbot
