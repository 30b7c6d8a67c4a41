#pragma once

#include <string>

namespace ballbot {

/// Text of a page of docs/troubleshooting/ that a check names, as it was when the program was
/// built, so that a record can be read where nothing else is; null if there is none of that name.
const char* troubleshootingPage(const std::string& name);

}  // namespace ballbot
