#pragma once

#include <string>
#include <vector>

namespace ballbot {

/// The values as 32-bit floats, little-endian, in base64 (RFC 4648). What is not finite becomes
/// NaN with one fixed bit pattern, so that equal data give equal text.
std::string base64Float32(const std::vector<double>& values);

}  // namespace ballbot
