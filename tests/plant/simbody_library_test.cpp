#include "plant/simbody_library.hpp"

#include <gmock/gmock.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

TEST(SimbodyLibrary, IsOfTheKindThisProgramWasCompiledFor) {
  EXPECT_NO_THROW(requireSimbodyKind(loadedSimbodyKind()));
}

TEST(SimbodyLibrary, OfTheOtherKindIsRefusedInWords) {
  const std::string other = loadedSimbodyKind() == "debug" ? "release" : "debug";
  try {
    requireSimbodyKind(other);
    FAIL() << "a '" << other << "' build was taken";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("is a '" + other + "' build"));
    EXPECT_THAT(e.what(), testing::HasSubstr("LD_LIBRARY_PATH"));
  }
}

}  // namespace
}  // namespace ballbot
