// One FMU in its process: what it is given and gives, and what it leaves behind.
#include "fmi/fmu_process.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "tests/fmi/fmu_fixture.hpp"
#include "tests/fmi/small_fmus.hpp"
#include "tests/fmi/spring_support.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const char* const kProgram = BALLBOT_BIN_DIR "/ballbot";

/// The temporary folder of FMU processes, one of their own.
class Leftovers : public ::testing::Test {
 protected:
  void SetUp() override {
    springFmu();  // written to the ordinary one
    valuesFmu();
    fs::create_directories(folder_);
    if (const char* old = std::getenv("TMPDIR")) before_ = old;
    ::setenv("TMPDIR", folder_.c_str(), 1);
  }
  void TearDown() override {
    before_.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", before_.c_str(), 1);
  }
  std::ptrdiff_t count() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }
  FmuUse spring(int trouble) const {
    FmuUse use;
    use.name = "spring";
    use.file = springFmu();
    use.outputs = {"force"};
    use.parameters = {{"trouble", trouble}, {"trouble_time", 0}};
    use.patience = std::chrono::milliseconds(trouble == 2 ? 1500 : 60'000);
    use.variable_steps = true;
    return use;
  }
  static void step(FmuProcess& fmu) {
    fmu.initialize(kSimStart);
    fmu.doStep(kSimStart, SimDuration{1'000'000}, {});
  }
  std::string folder_ = smallFmuFolder() + "/temporary", before_;
};

TEST_F(Leftovers, NothingStaysAfterACrashAHangOrAnEnd) {
  for (const int trouble : {0, 1, 2, 3, 4}) {
    {
      FmuProcess fmu(spring(trouble), kProgram);
      EXPECT_EQ(count(), 1);
      if (trouble == 0) {
        step(fmu);
      } else {
        EXPECT_NE(messageOf([&] { step(fmu); }), "nothing was thrown");
        EXPECT_EQ(count(), trouble == 4 ? 1 : 0) << "when the loss is said, all is tidy";
      }
    }
    EXPECT_EQ(count(), 0) << "trouble " << trouble;
  }
}

TEST_F(Leftovers, NothingStaysAfterAKill) {
  FmuProcess fmu(spring(0), kProgram);
  ::kill(fmu.pid(), SIGKILL);
  EXPECT_THAT(messageOf([&] { step(fmu); }), HasSubstr("signal 9"));
  EXPECT_EQ(count(), 0);
}

// The process of a run, killed while its FMU hangs: nobody is left who could ask for anything.
TEST_F(Leftovers, NothingStaysAfterAKillOfTheWholeRun) {
  const pid_t run = ::fork();
  if (run == 0) {
    FmuUse use = spring(2);
    use.patience = std::chrono::milliseconds(60'000);
    FmuProcess fmu(use, kProgram);
    step(fmu);
    ::_exit(0);
  }
  const auto within = [&](std::ptrdiff_t wanted) {
    for (int i = 0; i < 2000 && count() != wanted; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return count();
  };
  ASSERT_EQ(within(1), 1);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ::kill(run, SIGKILL);
  ::waitpid(run, nullptr, 0);
  EXPECT_EQ(within(0), 0);
}

TEST_F(Leftovers, AMissingTemporaryFolderIsAnOutputError) {
  ::setenv("TMPDIR", "/nowhere", 1);
  EXPECT_THROW(FmuProcess(spring(0), kProgram), OutputError);
}

// An FMU with the functions of Co-Simulation alone runs, and every type of number arrives.
TEST(FmuProcess, EveryTypeOfNumberGoesInAndOut) {
  FmuUse use;
  use.name = "values";
  use.file = valuesFmu();
  std::vector<double> values;
  for (const auto& [type, value] :
       std::vector<std::pair<std::string, double>>{{"Float32", 0.25},
                                                   {"Float64", 0.1},
                                                   {"Int8", -128},
                                                   {"UInt8", 255},
                                                   {"Int16", -32768},
                                                   {"UInt16", 65535},
                                                   {"Int32", -2147483648.0},
                                                   {"UInt32", 4294967295.0},
                                                   {"Int64", -9007199254740992.0},
                                                   {"UInt64", 9007199254740992.0},
                                                   {"Boolean", 1}}) {
    use.inputs.push_back("in_" + type);
    use.outputs.push_back("out_" + type);
    values.push_back(value);
  }
  FmuProcess fmu(use, kProgram);
  fmu.initialize(kSimStart);
  fmu.evaluate(values);
  EXPECT_EQ(fmu.outputs(), values);
  values[3] = 256;
  EXPECT_THAT(
      messageOf([&] { fmu.evaluate(values); }),
      HasSubstr("'in_UInt8' would be set to 256; it must be a whole number between 0 and 255"));
  values[3] = 2.5;
  EXPECT_THAT(messageOf([&] { fmu.evaluate(values); }), HasSubstr("it must be a whole number"));
}

TEST(FmuProcess, SaysWhichFunctionIsMissingAndWhatNoNumberCarries) {
  FmuUse use;
  use.name = "values";
  use.file = valuesFmu();
  use.saves_state = true;  // which it cannot
  FmuProcess fmu(use, kProgram);
  fmu.initialize(kSimStart);
  EXPECT_THAT(messageOf([&] { fmu.saveState(); }), HasSubstr("has no function fmi3GetFMUState"));
  use.outputs = {"huge"};
  FmuProcess huge(use, kProgram);
  EXPECT_THAT(messageOf([&] { huge.initialize(kSimStart); }),
              HasSubstr("'huge' is 1152921504606846977, beyond the whole numbers"));
}

}  // namespace
}  // namespace ballbot
