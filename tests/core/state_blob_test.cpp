#include "core/state_blob.hpp"

#include <functional>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "core/state_visitors.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

StateBlob example() {
  BlobWriter out;
  out.put<std::int32_t>(-5);
  out.put(0.1);
  out.putVector({1, 2, 3});
  return out.seal("plant", 2);
}

std::string errorOf(const StateBlob& blob, const std::string& kind, std::uint32_t version) {
  try {
    BlobReader in(blob, kind, version);
    in.get<std::int32_t>();
    in.get<double>();
    in.getVector();
    in.finish();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(StateBlob, ReadsBackWhatWasWritten) {
  BlobReader in(example(), "plant", 2);
  EXPECT_EQ(in.get<std::int32_t>(), -5);
  EXPECT_EQ(in.get<double>(), 0.1);
  EXPECT_EQ(in.getVector(), (std::vector<double>{1, 2, 3}));
  EXPECT_NO_THROW(in.finish());
}

struct Counter {
  std::int64_t count = 0;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.count);
  }
};

// GCC 12 once warned of this one, where all is inlined into one function.
TEST(StateBlob, HoldsAStateOfOneInteger) {
  const StateBlob blob = saveStateOf(Counter{-7}, "counter", 1);
  Counter read;
  restoreStateOf(read, blob, "counter", 1);
  EXPECT_EQ(read.count, -7);
}

TEST(StateBlob, EveryDamagedByteIsRefused) {
  const StateBlob good = example();
  for (std::size_t i = 0; i < good.size(); ++i) {
    StateBlob bad = good;
    bad[i] ^= 0x10;
    EXPECT_NE(errorOf(bad, "plant", 2), "no error") << "byte " << i;
  }
}

TEST(StateBlob, EveryTruncationIsRefused) {
  const StateBlob good = example();
  for (std::size_t n = 0; n < good.size(); ++n) {
    EXPECT_NE(errorOf(StateBlob(good.begin(), good.begin() + static_cast<long>(n)), "plant", 2),
              "no error");
  }
}

TEST(StateBlob, SaysWhatIsWrong) {
  EXPECT_THAT(errorOf(example(), "estimator", 2), HasSubstr("not a saved estimator state"));
  EXPECT_THAT(errorOf(example(), "plant", 3),
              HasSubstr("layout version 2, this program reads version 3"));
  StateBlob damaged = example();
  damaged.back() ^= 1;
  EXPECT_THAT(errorOf(damaged, "plant", 2), HasSubstr("checksum does not match"));
  EXPECT_THAT(errorOf({}, "plant", 2), HasSubstr("too short for a header"));
}

}  // namespace
}  // namespace ballbot
