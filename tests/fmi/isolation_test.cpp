// The shared objects as a machine without this project's libraries sees them.
#include <array>
#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>

#include <gmock/gmock.h>

#include "tests/fmi/fmu_fixture.hpp"

namespace ballbot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

std::string outputOf(const std::string& command) {
  std::string out;
  FILE* pipe = ::popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  while (std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
    out.append(buffer.data(), got);
  ::pclose(pipe);
  return out;
}

class IsolationTest : public ::testing::TestWithParam<int> {};

TEST_P(IsolationTest, ExportsTheFunctionsOfTheStandardAndNothingElse) {
  std::istringstream symbols(
      outputOf("nm -D --defined-only '" + unpackedFmu(GetParam()).libraryPath() + "'"));
  int functions = 0;
  for (std::string address, kind, name; symbols >> address >> kind >> name;) {
    EXPECT_THAT(name, HasSubstr("fmi" + std::to_string(GetParam())));
    ++functions;
  }
  EXPECT_EQ(functions, GetParam() == 2 ? 34 : 75);
}

// All that is found outside the FMU is the C and C++ runtime.
TEST_P(IsolationTest, NeedsNothingButTheRuntime) {
  const UnpackedFmu& fmu = unpackedFmu(GetParam());
  const std::string core = fs::path(fmu.libraryPath()).parent_path() / "ballbot-plant-core.so";
  const std::set<std::string> runtime{"linux-vdso.so.1", "libc.so.6", "libm.so.6", "libstdc++.so.6",
                                      "libgcc_s.so.1"};
  int own = 0;
  for (const std::string& file : {fmu.libraryPath(), core}) {
    const std::string said = outputOf("ldd -r '" + file + "' 2>&1");
    EXPECT_THAT(said, Not(HasSubstr("not found")));
    EXPECT_THAT(said, Not(HasSubstr("undefined symbol")));
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string name;
      words >> name;
      if (name.find("ld-linux") != std::string::npos || runtime.count(name)) continue;
      EXPECT_THAT(name, HasSubstr("ballbot-lib")) << line;
      EXPECT_THAT(line, HasSubstr(fmu.folder)) << "taken from elsewhere";
      ++own;
    }
  }
  EXPECT_GT(own, 5);
}

// This test has Simbody and LAPACK of its own, for all its libraries to see. Where those of the FMU
// look for a function they must find their own, not ours: the loader tells which it took. Static
// variables of inline functions are another matter: the ABI wants one of each in a process.
TEST_P(IsolationTest, TakesNoFunctionFromItsHost) {
  const std::string test = fs::read_symlink("/proc/self/exe").string();
  const char* one = GetParam() == 2 ? "Fmi2Test.StartsWhereItIsTold" : "Fmi3Test.StopTimeHolds";
  const std::string bindings = "LD_DEBUG=bindings '" + test + "' --gtest_filter=" + one +
                               " 2>&1 | grep -a 'binding file .*/binaries/.* to '";
  const char* runtime = "libc|libm|libstdc\\+\\+|libgcc_s|ld-linux-x86-64";
  std::istringstream own(outputOf(bindings + " | grep -a -c ' to .*/binaries/'"));
  int count = 0;
  own >> count;
  EXPECT_GT(count, 5000);
  EXPECT_EQ(outputOf(bindings + " | grep -a -v ' to .*/binaries/' | grep -a -v -E ' to .*/(" +
                     runtime + ")[.]so' | grep -a -v -E 'symbol `_Z(GV)?Z'"),
            "");
}

INSTANTIATE_TEST_SUITE_P(Fmi, IsolationTest, ::testing::Values(2, 3),
                         [](const auto& version) { return std::to_string(version.param); });

}  // namespace
}  // namespace ballbot
