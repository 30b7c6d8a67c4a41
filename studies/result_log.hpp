#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// Appends records to a file so that a kill or a power cut costs at most the record being written:
/// one line each, checksum first, on the disk before append() returns.
class ResultLog {
 public:
  /// Opens `path` for appending, and makes it if need be. @throw OutputError
  explicit ResultLog(const std::string& path);
  ~ResultLog();
  ResultLog(const ResultLog&) = delete;
  ResultLog& operator=(const ResultLog&) = delete;

  /// @param record  one line of text, without a line end. @throw OutputError
  void append(const std::string& record);

 private:
  std::string path_;
  int file_ = -1;
};

/// What readResultLog() found.
struct ResultLogContent {
  std::vector<std::string> records;  ///< in the order they were written
  int damaged = 0;                   ///< lines whose checksum is wrong, a cut-off last one included
};

/// @throw InputError if the file cannot be read.
ResultLogContent readResultLog(const std::string& path);

}  // namespace ballbot
