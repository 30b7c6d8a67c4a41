// FMU files with random damage: each is read or refused in words, in bounded time and memory. The
// damage depends on its number alone, so what fails once fails again. BALLBOT_FUZZ_SECONDS says how
// long to go on; by default it is a fixed number of files, for a second or two.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <sstream>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/error.hpp"
#include "fmi/fmu_ports.hpp"
#include "tests/fmi/small_fmus.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kFilesByDefault = 600;
constexpr std::chrono::seconds kLongestFile{20};  // on a loaded machine, with a sanitizer
constexpr long kMostMemory_kB = 1536 * 1024;      // of the whole process
constexpr UnpackLimits kLimits{std::uint64_t{16} << 20, 1000};

std::string bytesOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Model descriptions with something of everything.
std::vector<std::string> descriptions() {
  return {
      bytesOf(BALLBOT_SOURCE_DIR "/tests/fmi/spring_fmu.xml"),
      fmi3Xml("<Float64 name=\"u\" causality=\"input\" valueReference=\"1\" unit=\"m\" min=\"0\">"
              "<Dimension start=\"2\"/><Dimension start=\"3\"/><Alias name=\"hand.x\"/></Float64>"
              "<Enumeration name=\"e\" declaredType=\"T\" valueReference=\"2\" start=\"1\"/>"
              "<Float64 name=\"y\" causality=\"output\" valueReference=\"3\"/>",
              "<UnitDefinitions><Unit name=\"m\"><BaseUnit m=\"1\" factor=\"1e-3\"/></Unit>"
              "</UnitDefinitions><TypeDefinitions><EnumerationType name=\"T\">"
              "<Item name=\"a\" value=\"1\"/></EnumerationType></TypeDefinitions>"
              "<ModelStructure><Output valueReference=\"3\" dependencies=\"1 2\"/>"
              "</ModelStructure>")};
}

class Mutator {
 public:
  explicit Mutator(std::uint32_t number) : random_(number) {}

  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

  /// Damage that knows nothing of what it damages: for archives.
  void damageBytes(std::string& bytes) {
    for (std::size_t n = 1 + below(4); n > 0 && !bytes.empty(); --n) {
      const std::size_t at = below(bytes.size()), length = 1 + below(bytes.size() - at);
      switch (below(6)) {
        case 0:
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
          break;
        case 1:
          bytes[at] = static_cast<char>(below(256));
          break;
        case 2:
          bytes.erase(at, below(2) == 0 ? length : 1 + below(8));
          break;
        case 3:
          bytes.insert(at, bytes.substr(at, std::min<std::size_t>(length, 4096)));
          break;
        case 4:
          bytes.resize(at);
          break;
        default:
          overwrite(bytes, at);
          break;
      }
    }
  }

  /// Damage among words, tags and numbers: for texts.
  void damageText(std::string& text) {
    static const char* const words[] = {"-1",
                                        "0",
                                        "4294967296",
                                        "99999999999999999999",
                                        "1e308",
                                        "nan",
                                        "-2147483648",
                                        "65536",
                                        "\"",
                                        "<",
                                        ">",
                                        "/>",
                                        "&",
                                        "&#0;",
                                        "&#x110000;",
                                        "&lt;",
                                        "<![CDATA[",
                                        "<!--",
                                        "<?",
                                        "]]>",
                                        "\xff",
                                        "[1]",
                                        "[2,3]",
                                        "[",
                                        "]",
                                        "Float64",
                                        "Real",
                                        "String",
                                        "<Dimension start=\"99999\"/>",
                                        "<Alias name=\"u\"/>",
                                        "name=\"u\"",
                                        "2.0",
                                        "3.0",
                                        "'"};
    for (std::size_t n = 1 + below(6); n > 0 && !text.empty(); --n) {
      const std::size_t at = below(text.size());
      switch (below(5)) {
        case 0:
          text.insert(at, words[below(std::size(words))]);
          break;
        case 1:
          replaceNumber(text, at, words[below(8)]);
          break;
        case 2:
          text.erase(at, 1 + below(60));
          break;
        case 3:
          text.insert(below(text.size()), text.substr(at, 1 + below(400)));
          break;
        default:
          damageBytes(text);
          break;
      }
    }
    if (below(40) == 0) text.insert(below(text.size() + 1), deep(20'000));
    if (below(40) == 0) text.insert(below(text.size() + 1), repeated("<Unit/>", 20'000));
  }

 private:
  /// A number of the archive's own, e.g. a size, becomes a hard one.
  void overwrite(std::string& bytes, std::size_t at) {
    const std::uint32_t hard[] = {0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0xfffffffe, 0xffff};
    const std::uint32_t value = hard[below(std::size(hard))];
    for (std::size_t i = 0; i < sizeof value && at + i < bytes.size(); ++i)
      bytes[at + i] = static_cast<char>(value >> 8 * i);
  }
  static void replaceNumber(std::string& text, std::size_t from, const char* with) {
    const std::size_t begin = text.find_first_of("0123456789", from);
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_not_of("0123456789", begin), text.size());
    text.replace(begin, end - begin, with);
  }
  static std::string repeated(const std::string& part, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += part;
    return out;
  }
  static std::string deep(int levels) { return repeated("<a>", levels); }

  std::mt19937 random_;
};

class FmuMutation {
 public:
  FmuMutation() { fs::create_directories(folder_); }

  /// The file of that number.
  void write(std::uint32_t number) {
    Mutator mutator(number);
    std::string xml = descriptions_[mutator.below(descriptions_.size())];
    const bool archive = mutator.below(2) == 0;
    if (!archive) mutator.damageText(xml);
    writeZip(file_, {{"modelDescription.xml", xml},
                     {"binaries/linux64/spring.so", std::string(3000, 'x'), true},
                     {"resources/data/numbers.txt", repeatedData_}});
    if (!archive) return;
    std::string bytes = bytesOf(file_);
    mutator.damageBytes(bytes);
    std::ofstream(file_, std::ios::binary) << bytes;
  }

  /// Everything that an import does with a file before code of it runs.
  void use() {
    try {
      const FmuDescription fmu = readFmuDescription(file_);
      for (const FmuPort& port : allPorts(fmu)) {
        values_ += port.variables.size();
        if (port.size > 0) findPortOf(fmu, port.name);
        for (const ImportedVariable& v : port.variables) refused_ += !refusalOf(v, 2.5).empty();
      }
    } catch (const InputError& e) {
      EXPECT_GT(std::string(e.what()).size(), 10U);
      ++refused_;
    }
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    try {
      unpackZip(file_, folder_, kLimits);
    } catch (const InputError& e) {
      EXPECT_GT(std::string(e.what()).size(), 10U);
    }
  }
  std::size_t values() const { return values_; }
  std::size_t refused() const { return refused_; }

 private:
  std::vector<std::string> descriptions_ = descriptions();
  std::string repeatedData_ = std::string(20'000, '7');
  std::string folder_ = smallFmuFolder() + "/mutated", file_ = smallFmuFolder() + "/mutated.fmu";
  std::size_t values_ = 0, refused_ = 0;
};

long memory_kB() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST(FmuMutation, EveryDamageIsReadOrRefusedInWords) {
  const char* seconds = std::getenv("BALLBOT_FUZZ_SECONDS");
  std::optional<Clock::time_point> until;
  if (seconds) until = Clock::now() + std::chrono::seconds(std::atoi(seconds));
  FmuMutation mutation;
  std::uint32_t number = 0;
  for (; until ? Clock::now() < *until : number < kFilesByDefault; ++number) {
    mutation.write(number);
    const auto start = Clock::now();
    ASSERT_NO_THROW(mutation.use()) << "file " << number;
    ASSERT_LT(Clock::now() - start, kLongestFile) << "file " << number;
    ASSERT_LT(memory_kB(), kMostMemory_kB) << "file " << number;
  }
  RecordProperty("files", static_cast<int>(number));
  EXPECT_GT(mutation.values(), number / 4) << "some damage leaves something to read";
  EXPECT_GT(mutation.refused(), number / 10) << "some does not";
}

}  // namespace
}  // namespace ballbot
