#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// File of a record that has the digest of each of the others; written last.
constexpr const char* kRecordSums = "digests.txt";

/// @return 0, or the error number of what went wrong
int writeSums(const std::string& folder);

/// What of a record is not as it was written, in words; empty if all is. It guards against
/// accidents, not against somebody who means harm.
std::vector<std::string> recordDamage(const std::string& folder);

}  // namespace ballbot
