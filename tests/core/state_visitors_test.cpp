#include "core/state_visitors.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

enum class Phase : std::int8_t { kFirst, kSecond, kThird };

struct Part {
  double value = 0;
  bool on = false;

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit(self.value);
    visit(self.on);
  }
};

/// One of everything that a state may be made of.
struct Whole {
  bool flag = false;
  int count = 0;
  std::int64_t ticks = 0;
  std::uint8_t byte = 0;
  double number = 0;
  Phase phase = Phase::kFirst;
  SimTime time{};
  SimDuration duration{};
  Eigen::Vector3d column = Eigen::Vector3d::Zero();
  Eigen::RowVector2d row = Eigen::RowVector2d::Zero();
  Eigen::Matrix<double, 2, 3> matrix = Eigen::Matrix<double, 2, 3>::Zero();
  std::array<std::int64_t, 2> counts{};
  std::array<Part, 2> parts{};
  std::vector<double> numbers = std::vector<double>(3);
  std::vector<Part> units = std::vector<Part>(2);
  std::vector<std::vector<double>> rows{{0}, {0, 0}};
  Part part;
  StateBlob sealed;
  int used = 0;  ///< of three

  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit.form("a form", [](const std::string& saved) { return "not of " + saved; });
    visit(self.flag);
    visit(self.count);
    visit(self.ticks);
    visit(self.byte);
    visit(self.number);
    visit(self.phase);
    visit(self.time);
    visit(self.duration);
    visit(self.column);
    visit(self.row);
    visit(self.matrix);
    visit(self.counts);
    visit(self.parts);
    visit(self.numbers);
    visit.sameCount(self.units.size(), "units");
    visit(self.units);
    visit(self.rows);
    visit(self.part);
    visit(self.sealed);
    visit.countUpTo(3, self.used);
  }
};

Whole example() {
  Whole w;
  w.flag = true;
  w.count = -5;
  w.ticks = std::int64_t{1} << 40;
  w.byte = 200;
  w.number = 0.1;
  w.phase = Phase::kThird;
  w.time = simTimeFromNs(7);
  w.duration = SimDuration{-8};
  w.column << 1, 2, 3;
  w.row << 4, 5;
  w.matrix << 1, 2, 3, 4, 5, 6;
  w.counts = {9, -9};
  w.parts[1] = {2.5, true};
  w.numbers = {0.5, 0.25, 0.125};
  w.units[0] = {-1, true};
  w.rows = {{1}, {2, 3}};
  w.part = {1e300, true};
  w.sealed = {1, 2, 3};
  w.used = 2;
  return w;
}

StateBlob saved(const Whole& w) { return saveStateOf(w, "example", 1); }

std::string errorOf(Whole& w, const StateBlob& blob) {
  try {
    restoreStateOf(w, blob, "example", 1);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(StateVisitors, WhatWasSavedComesBack) {
  const Whole a = example();
  Whole b;
  ASSERT_EQ(errorOf(b, saved(a)), "no error");
  EXPECT_TRUE(b.flag);
  EXPECT_EQ(b.count, -5);
  EXPECT_EQ(b.ticks, std::int64_t{1} << 40);
  EXPECT_EQ(b.byte, 200);
  EXPECT_EQ(b.number, 0.1);
  EXPECT_EQ(b.phase, Phase::kThird);
  EXPECT_EQ(b.time, simTimeFromNs(7));
  EXPECT_EQ(b.duration, SimDuration{-8});
  EXPECT_EQ(b.column, a.column);
  EXPECT_EQ(b.row, a.row);
  EXPECT_EQ(b.matrix, a.matrix);
  EXPECT_EQ(b.counts, a.counts);
  EXPECT_EQ(b.parts[0].value, 0);
  EXPECT_EQ(b.parts[1].value, 2.5);
  EXPECT_EQ(b.numbers, a.numbers);
  EXPECT_EQ(b.units[0].value, -1);
  EXPECT_TRUE(b.units[0].on);
  EXPECT_EQ(b.rows, a.rows);
  EXPECT_EQ(b.part.value, 1e300);
  EXPECT_EQ(b.sealed, a.sealed);
  EXPECT_EQ(b.used, 2);
  EXPECT_EQ(saved(b), saved(a));
}

// Saved states outlive the program that wrote them.
TEST(StateVisitors, TheBytesAreTheValuesOneAfterTheOther) {
  struct Few {
    bool flag = true;
    int count = 2;
    SimTime time = simTimeFromNs(3);
    std::vector<double> numbers{4, 5};
    static void visitState(const Few& self, StateSaver& visit) {
      visit(self.flag);
      visit(self.count);
      visit(self.time);
      visit(self.numbers);
    }
  };
  BlobWriter out;
  out.put(true);
  out.put<std::int32_t>(2);
  out.put<std::int64_t>(3);
  out.put<std::uint64_t>(2);
  out.put(4.0);
  out.put(5.0);
  EXPECT_EQ(saveStateOf(Few{}, "few", 1), out.seal("few", 1));
}

TEST(StateVisitors, EveryDamagedOrMissingByteIsRefusedAndChangesNothing) {
  const StateBlob good = saved(example());
  Whole w;
  const StateBlob before = saved(w);
  for (std::size_t i = 0; i < good.size(); ++i) {
    StateBlob bad = good;
    bad[i] ^= 0x10;
    EXPECT_NE(errorOf(w, bad), "no error") << "byte " << i;
    bad.assign(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_NE(errorOf(w, bad), "no error") << i << " bytes";
  }
  EXPECT_EQ(saved(w), before);
}

// The checksum of these is right: only the visitor sees that they do not fit.
TEST(StateVisitors, WhatDoesNotFitIsRefusedAndChangesNothing) {
  Whole w;
  const StateBlob before = saved(w);
  const auto refusal = [&](auto&& change) {
    Whole other = example();
    change(other);
    return errorOf(w, saved(other));
  };
  EXPECT_EQ(refusal([](Whole& o) { o.numbers.resize(4); }),
            "saved example state: 4 numbers where this one has 3");
  EXPECT_EQ(refusal([](Whole& o) { o.rows[1].resize(1); }),
            "saved example state: 1 numbers where this one has 2");
  EXPECT_EQ(refusal([](Whole& o) { o.units.resize(1); }),
            "saved example state: 1 units where this one has 2");
  EXPECT_EQ(refusal([](Whole& o) { o.used = 4; }),
            "saved example state: 4 values where this one holds up to 3");
  EXPECT_EQ(refusal([](Whole& o) { o.used = -1; }),
            "saved example state: -1 values where this one holds up to 3");
  EXPECT_EQ(saved(w), before);
}

TEST(StateVisitors, AnotherFormIsRefusedInTheWordsOfTheClass) {
  const auto visiting = [](const std::string& form) {
    return [form](auto& visit) {
      visit.form(form, [&](const std::string& saved) { return saved + " is not " + form; });
    };
  };
  const StateBlob blob = sealState("example", 1, visiting("round"));
  EXPECT_NO_THROW(openState(blob, "example", 1, visiting("round")));
  try {
    openState(blob, "example", 1, visiting("square"));
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "round is not square");
  }
}

TEST(StateVisitors, BytesThatAreLeftOverAreRefused) {
  const StateBlob blob = sealState("example", 1, [](StateSaver& visit) {
    const Part part;
    visit(part);
    visit(part);
  });
  Part part{3, true};
  EXPECT_THROW(restoreStateOf(part, blob, "example", 1), InputError);
  EXPECT_EQ(part.value, 3);
}

TEST(StateVisitors, TheHashIsOfAllValues) {
  const auto hashOf = [](Part part, Eigen::Vector2d column, std::vector<double> numbers) {
    StateHasher visit;
    visit(part);
    visit(column);
    visit(numbers);
    return visit.hash();
  };
  const std::uint64_t hash = hashOf({1, true}, {2, 3}, {4});
  EXPECT_EQ(hashOf({1, true}, {2, 3}, {4}), hash);
  EXPECT_NE(hashOf({2, true}, {2, 3}, {4}), hash);
  EXPECT_NE(hashOf({1, false}, {2, 3}, {4}), hash);
  EXPECT_NE(hashOf({1, true}, {2, 4}, {4}), hash);
  EXPECT_NE(hashOf({1, true}, {2, 3}, {5}), hash);
}

TEST(StateVisitors, AHasherThatWasClearedBeginsAnew) {
  StateHasher once, again;
  const double other = 5, number = 7;
  again(other);
  again.clear();
  once(number);
  again(number);
  EXPECT_EQ(once.hash(), again.hash());
}

}  // namespace
}  // namespace ballbot
