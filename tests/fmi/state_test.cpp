// Saved states in hands that mistreat them, and instances in threads.
#include <thread>

#include <gmock/gmock.h>

#include "fmi/fmi2_library.hpp"
#include "fmi/fmu_slave.hpp"
#include "tests/fmi/fmu_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;

std::unique_ptr<FmuSlave> initialized(int version) {
  const UnpackedFmu& fmu = unpackedFmu(version);
  auto slave = loadFmu(fmu.description, fmu.folder, "one", {});
  slave->initialize(kSimStart);
  slave->doStep(kSimStart, SimDuration{10'000'000});
  return slave;
}

class StateTest : public ::testing::TestWithParam<int> {};

TEST_P(StateTest, GarbageIsRefusedAndNothingChanges) {
  const auto slave = initialized(GetParam());
  const StateBlob good = slave->saveState();
  const auto refused = [&](const StateBlob& bad) {
    const std::string words = messageOf([&] { slave->restoreState(bad); });
    slave->restoreState(good);  // the way out of the error
    EXPECT_EQ(slave->saveState(), good);
    return words;
  };
  EXPECT_THAT(refused(StateBlob(good.size(), 0xA5)),
              HasSubstr("these bytes are not a saved plant FMU state"));
  EXPECT_THAT(refused(StateBlob(3, 0)), HasSubstr("too short"));
  for (std::size_t cut : {std::size_t{33}, good.size() / 2, good.size() - 1}) {
    EXPECT_THAT(refused(StateBlob(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(cut))),
                HasSubstr("header says"));
  }
  for (std::size_t at = 32; at < good.size(); at += 97) {
    StateBlob flipped = good;
    flipped[at] ^= 0x10;
    EXPECT_THAT(refused(flipped), HasSubstr("damaged"));
  }
  EXPECT_THAT(refused(initialized(GetParam() == 2 ? 3 : 2)->saveState()),
              HasSubstr("another scenario, robot or FMI version"));
}

TEST_P(StateTest, HoldsNoPointersAndNoPadding) {
  EXPECT_EQ(initialized(GetParam())->saveState(), initialized(GetParam())->saveState());
}

INSTANTIATE_TEST_SUITE_P(Fmi, StateTest, ::testing::Values(2, 3),
                         [](const auto& version) { return std::to_string(version.param); });

TEST(State, PointersThatAreNotOursAreRefused) {
  const UnpackedFmu& unpacked = unpackedFmu(2);
  const Fmi2Library fmu(unpacked.libraryPath());
  const fmi2CallbackFunctions callbacks{nullptr, nullptr, nullptr, nullptr, nullptr};
  const std::string resources = unpacked.folder + "/resources";
  const fmi2Component c =
      fmu.fmi2Instantiate("one", fmi2CoSimulation, unpacked.description.token.c_str(),
                          resources.c_str(), &callbacks, fmi2False, fmi2False);
  ASSERT_NE(c, nullptr);
  int nonsense = 0;
  fmi2FMUstate foreign = &nonsense, state = nullptr, empty = nullptr;
  std::size_t size = 0;
  ASSERT_EQ(fmu.fmi2GetFMUstate(c, &state), fmi2OK);
  EXPECT_EQ(fmu.fmi2SetFMUstate(c, foreign), fmi2Error);
  EXPECT_EQ(fmu.fmi2SetFMUstate(c, nullptr), fmi2Error);
  EXPECT_EQ(fmu.fmi2SerializedFMUstateSize(c, foreign, &size), fmi2Error);
  EXPECT_EQ(fmu.fmi2FreeFMUstate(c, &foreign), fmi2Error);
  EXPECT_EQ(fmu.fmi2GetFMUstate(c, nullptr), fmi2Error);
  EXPECT_EQ(fmu.fmi2FreeFMUstate(c, &empty), fmi2OK);
  ASSERT_EQ(fmu.fmi2SerializedFMUstateSize(c, state, &size), fmi2OK);
  std::vector<char> bytes(size);
  EXPECT_EQ(fmu.fmi2SerializeFMUstate(c, state, bytes.data(), size - 1), fmi2Error);
  EXPECT_EQ(fmu.fmi2SerializeFMUstate(c, state, nullptr, size), fmi2Error);
  EXPECT_EQ(fmu.fmi2DeSerializeFMUstate(c, nullptr, size, &foreign), fmi2Error);
  EXPECT_EQ(fmu.fmi2SetFMUstate(c, state), fmi2OK);
  const fmi2FMUstate before = state;
  EXPECT_EQ(fmu.fmi2GetFMUstate(c, &state), fmi2OK);  // overwrites
  EXPECT_EQ(state, before);
  EXPECT_EQ(fmu.fmi2FreeFMUstate(c, &state), fmi2OK);
  EXPECT_EQ(state, nullptr);
  EXPECT_EQ(fmu.fmi2FreeFMUstate(c, const_cast<void**>(&before)), fmi2Error);  // twice
  fmu.fmi2FreeInstance(c);
}

TEST(State, SixteenInstancesInThreadsAgree) {
  for (const int version : {2, 3}) {
    unpackedFmu(version);
    std::vector<StateBlob> ends(16);
    std::vector<std::thread> threads;
    for (StateBlob& end : ends) {
      threads.emplace_back([&end, version] {
        const auto slave = initialized(version);
        for (int k = 1; k < 10; ++k)
          slave->doStep(kSimStart + k * SimDuration{10'000'000}, SimDuration{10'000'000});
        end = slave->saveState();
      });
    }
    for (std::thread& t : threads) t.join();
    for (const StateBlob& end : ends) EXPECT_EQ(end, ends.front());
  }
}

}  // namespace
}  // namespace ballbot
