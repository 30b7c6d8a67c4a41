#include "hil/record/record_sums.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/digest.hpp"
#include "core/whole_file.hpp"

namespace ballbot {
namespace {

/// Of a file's bytes; "" if it cannot be read.
std::string sumOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return "";
  std::stringstream bytes;
  bytes << in.rdbuf();
  Digest digest;
  digest.add(bytes.str());
  return digest.hex();
}

}  // namespace

int writeSums(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    names.push_back(file.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  std::string text;
  for (const std::string& name : names) text += sumOf(folder + "/" + name) + "  " + name + "\n";
  return writeWholeFile(folder + "/" + kRecordSums, text);
}

std::vector<std::string> recordDamage(const std::string& folder) {
  std::ifstream in(folder + "/" + kRecordSums);
  if (!in) {
    return {std::string(kRecordSums) + " is missing, so nobody knows whether the record is whole"};
  }
  std::vector<std::string> out;
  for (std::string sum, name; in >> sum >> name;) {
    const std::string found = sumOf(folder + "/" + name);
    if (found.empty()) {
      out.push_back(name + " is missing");
    } else if (found != sum) {
      out.push_back(name + " is not as it was written");
    }
  }
  return out;
}

}  // namespace ballbot
