#include "plant/simbody_library.hpp"

#include <array>

#include <Simbody.h>
#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

#ifdef NDEBUG
constexpr const char* kCompiledFor = "release";
#else
constexpr const char* kCompiledFor = "debug";
#endif

}  // namespace

std::string loadedSimbodyKind() {
  std::array<char, 32> kind{};
  SimTK_about_simbody("debug", static_cast<int>(kind.size()), kind.data());
  return kind.data();
}

void requireSimbodyKind(const std::string& loaded) {
  if (loaded == kCompiledFor) return;
  throw InputError(
      fmt::format("the Simbody library that was loaded is a '{}' build, this program was compiled "
                  "for a '{}' one. "
                  "Is LD_LIBRARY_PATH set? Unset it, or build again: ./bootstrap build "
                  "(--native-simbody for a release build)",
                  loaded, kCompiledFor));
}

}  // namespace ballbot
