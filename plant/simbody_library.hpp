#pragma once

#include <string>

namespace ballbot {

/// What the loaded Simbody says of itself: "debug" (built with assertions, as Debian's package is)
/// or "release" (built with NDEBUG).
std::string loadedSimbodyKind();

/// Simbody's classes have another layout with NDEBUG than without, and a program that meets the
/// other library, say by LD_LIBRARY_PATH, would crash or compute nonsense.
/// @param loaded  loadedSimbodyKind()
/// @throw InputError where `loaded` is not the kind this program was compiled for
void requireSimbodyKind(const std::string& loaded);

}  // namespace ballbot
