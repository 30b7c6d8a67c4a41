#include "core/error.hpp"

#include <gtest/gtest.h>

namespace ballbot {
namespace {

// A script that starts runs repeats what was lost. What the input caused comes again.
TEST(ExitCodes, ThreeIsForALostParticipantOnly) {
  EXPECT_EQ(LostParticipantError("plant", "").exitCode(), ExitCode::kLostParticipant);
  EXPECT_EQ(InputError("").exitCode(), ExitCode::kBadInput);
  EXPECT_EQ(NumericalError("").exitCode(), ExitCode::kBadInput);
  EXPECT_THROW(throw NumericalError("no equilibrium"), InputError);
}

}  // namespace
}  // namespace ballbot
