#include "hil/machine/proc_text.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

namespace ballbot {
namespace {

constexpr int kMostCpus = 4096;

bool isNumber(const std::string& text) {
  return !text.empty() && text.size() < 6 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::string firstLine(const std::string& root, const std::string& path) {
  std::ifstream in(root + path);
  std::string line;
  std::getline(in, line);
  return line;
}

std::vector<std::string> namesIn(const std::string& root, const std::string& path) {
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(root + path, failed)) {
    names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<int> parseCpuList(const std::string& text) {
  std::vector<int> cpus;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    const std::size_t dash = part.find('-');
    const std::string low = part.substr(0, dash);
    const std::string high = dash == std::string::npos ? low : part.substr(dash + 1);
    // isolcpus= has flags before its list: "managed_irq,domain,2-3".
    if (!isNumber(low) || !isNumber(high)) continue;
    for (int cpu = std::stoi(low); cpu <= std::min(std::stoi(high), kMostCpus); ++cpu) {
      cpus.push_back(cpu);
    }
  }
  return cpus;
}

std::string cpuListText(const std::vector<int>& cpus) {
  if (cpus.empty()) return "none";
  std::string text;
  for (std::size_t i = 0; i < cpus.size();) {
    std::size_t last = i;
    while (last + 1 < cpus.size() && cpus[last + 1] == cpus[last] + 1) ++last;
    if (!text.empty()) text += ',';
    text += last == i ? std::to_string(cpus[i]) : fmt::format("{}-{}", cpus[i], cpus[last]);
    i = last + 1;
  }
  return text;
}

bool contains(const std::vector<int>& cpus, int cpu) {
  return std::find(cpus.begin(), cpus.end(), cpu) != cpus.end();
}

InterruptTable parseInterrupts(const std::string& text) {
  InterruptTable table;
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  std::istringstream head(line);
  for (std::string word; head >> word;) {
    if (word.compare(0, 3, "CPU") == 0 && isNumber(word.substr(3))) {
      table.cpus.push_back(std::stoi(word.substr(3)));
    }
  }
  while (std::getline(in, line)) {
    std::istringstream words(line);
    InterruptLine entry;
    if (!(words >> entry.number) || entry.number.back() != ':') continue;
    entry.number.pop_back();
    std::int64_t count = 0;
    while (entry.counts.size() < table.cpus.size() && words >> count) entry.counts.push_back(count);
    if (entry.counts.size() < table.cpus.size()) continue;  // ERR and MIS have one count for all
    std::getline(words >> std::ws, entry.name);
    table.lines.push_back(std::move(entry));
  }
  return table;
}

std::string bootParameter(const std::string& command_line, const std::string& name) {
  std::istringstream in(command_line);
  for (std::string word; in >> word;) {
    if (word == name) return "on";
    if (word.compare(0, name.size() + 1, name + "=") == 0) return word.substr(name.size() + 1);
  }
  return "";
}

}  // namespace ballbot
