#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ballbot {

// Texts of /proc and /sys. All paths are below a root, so that a test can bring a machine of its
// own.

/// First line of a file, without its end; "" if it is not there.
std::string firstLine(const std::string& root, const std::string& path);
/// Names in a folder, sorted; none if it is not there.
std::vector<std::string> namesIn(const std::string& root, const std::string& path);

/// Numbers of a list as the kernel writes them: "0-2,5" is 0, 1, 2, 5. What is no list gives none.
std::vector<int> parseCpuList(const std::string& text);
/// The same list back as text; "none" if it is empty.
std::string cpuListText(const std::vector<int>& cpus);
bool contains(const std::vector<int>& cpus, int cpu);

/// One line of /proc/interrupts.
struct InterruptLine {
  std::string number;                ///< "36", or "LOC" for one of the processor's own
  std::vector<std::int64_t> counts;  ///< by column
  std::string name;                  ///< chip and device, as it stands there
};
/// Lines of /proc/interrupts, and the processors of its columns.
struct InterruptTable {
  std::vector<int> cpus;
  std::vector<InterruptLine> lines;
};
InterruptTable parseInterrupts(const std::string& text);

/// Value of a word of the kernel's command line: "isolcpus=2,3" gives "2,3"; "" if it is not there.
std::string bootParameter(const std::string& command_line, const std::string& name);

}  // namespace ballbot
