#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ballbot {

/// An HDF5 file being made: groups of columns. The same content gives the same bytes: no times
/// of creation are kept in it. It is made in memory and written by finish(), because the library
/// crashes when a disk is full. @throw OutputError from every call
class Hdf5File {
 public:
  explicit Hdf5File(const std::string& path);
  ~Hdf5File();
  /// Writes it, as a whole or not at all. Without this nothing is written.
  void finish();

  /// Columns added from now on belong to this group; before the first, to the file itself.
  void beginGroup(const std::string& name);
  /// 64-bit floating point, with its unit ("1" if empty) as attribute `unit`.
  void addNumbers(const std::string& name, const std::vector<double>& values,
                  const std::string& unit);
  /// UTF-8, of fixed length, padded with zeros.
  void addTexts(const std::string& name, const std::vector<std::string>& texts);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ballbot
