#pragma once

#include <string>
#include <vector>

#include "hil/record/fault_record.hpp"

namespace ballbot {

/// What came of writing a record.
struct WrittenRecord {
  std::string folder;                 ///< that was made; "" if none could be
  std::vector<std::string> troubles;  ///< what could not be written, with the reason
};

/// Writes a record into a new folder below `records`: record.json, fault.html, frames.log,
/// frames.asc, decoded.csv, cycles.csv, digests.txt. Its name is the first check's, or "kept", with
/// the bus time; a number is added where that is taken, so nothing is overwritten. What cannot be
/// written leaves the rest as it is. Never throws.
WrittenRecord writeRecord(const FaultRecord& record, const std::string& records) noexcept;

}  // namespace ballbot
