#include "hil/record/write_record.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>

#include <fmt/format.h>

#include "core/whole_file.hpp"
#include "hil/cycle_csv.hpp"
#include "hil/record/can_log_text.hpp"
#include "hil/record/fault_page.hpp"
#include "hil/record/frame_words.hpp"
#include "hil/record/record_json.hpp"
#include "hil/record/record_sums.hpp"
#include "report/json_text.hpp"
#include "report/write_report.hpp"

namespace ballbot {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPageSamples = 16'000;  // of a line: every cycle of 20 s at 400 Hz, and more
constexpr int kMostFolders = 10'000;

std::string nameOf(const FaultRecord& record) {
  const char* what =
      record.hasFault() ? checkOf(record.recorder.first().finding.fault).name : "kept";
  return fmt::format("bench-{}-{:.4f}s", what, 1e-9 * static_cast<double>(record.zeroNs()));
}

/// A folder that was not there before.
std::string newFolder(const std::string& records, const std::string& name) {
  fs::create_directories(records);
  for (int i = 1; i < kMostFolders; ++i) {
    const fs::path path = fs::path(records) / (i == 1 ? name : fmt::format("{}-{}", name, i));
    if (fs::create_directory(path)) return path.string();
  }
  throw fs::filesystem_error("no free name", records, std::make_error_code(std::errc::file_exists));
}

/// A text file that is written line by line; 20 s are tens of megabytes.
class LineFile {
 public:
  explicit LineFile(const std::string& path) : file_(std::fopen(path.c_str(), "wx")) {
    if (file_ == nullptr) error_ = errno;
  }
  ~LineFile() { close(); }
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;
  void add(const std::string& text) {
    if (error_ != 0) return;
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) error_ = errno;
  }
  /// 0, or the first thing that went wrong.
  int close() {
    if (file_ == nullptr) return error_;
    if (std::fclose(file_) != 0 && error_ == 0) error_ = errno;
    file_ = nullptr;
    return error_;
  }

 private:
  std::FILE* file_;
  int error_ = 0;
};

int writeCandump(const FaultRecord& record, const std::string& path) {
  LineFile file(path);
  for (const RecordedFrame* f : record.frames()) {
    if (f->refused) continue;  // was never on the bus
    file.add(candumpLine(*f, record.facts.epoch_offset_ns));
  }
  return file.close();
}

int writeAsc(const FaultRecord& record, const std::string& path) {
  LineFile file(path);
  const auto frames = record.frames();
  const std::int64_t zero = frames.empty() ? 0 : frames.front()->time_ns;
  file.add(ascHeader(zero + record.facts.epoch_offset_ns));
  for (const RecordedFrame* f : frames) {
    if (!f->refused) file.add(ascLine(*f, zero));
  }
  file.add(ascFooter());
  return file.close();
}

/// A cell of a CSV table; in quotes where it holds what would end one.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

int writeDecoded(const FaultRecord& record, const std::string& path) {
  LineFile file(path);
  file.add("time_s,cycle,bus,direction,id,node,who,service,meaning\n");
  for (const RecordedFrame* f : record.frames()) {
    const FrameWords w = wordsOf(*f, record.config());
    file.add(fmt::format("{:.6f},{},{},{},{:03X},{},{},{},{}\n",
                         1e-9 * static_cast<double>(f->time_ns), f->cycle, f->bus,
                         f->sent ? "sent" : "came", f->frame.id, w.node, cell(w.who), w.service,
                         cell(w.meaning)));
  }
  return file.close();
}

int writeCycles(const FaultRecord& record, const std::string& path) {
  LineFile file(path);
  file.add(cycleCsvHeader());
  const auto& cycles = record.recorder.cycles();
  for (std::size_t i = 0; i < cycles.size(); ++i) file.add(cycleCsvLine(cycles[i]));
  return file.close();
}

int writePage(const FaultRecord& record, const std::string& path) {
  return writeWholeFile(path, reportPage(faultPage(record), "", {kPageSamples, 1}));
}

int writeJson(const FaultRecord& record, const std::string& path) {
  return writeWholeFile(path, jsonText(recordJson(record)) + "\n");
}

}  // namespace

WrittenRecord writeRecord(const FaultRecord& record, const std::string& records) noexcept {
  WrittenRecord out;
  try {
    out.folder = newFolder(records, nameOf(record));
  } catch (const std::exception& e) {
    out.troubles.push_back(
        fmt::format("{}: no folder for a record can be made: {}", records, e.what()));
    return out;
  }
  // What says most in least room comes first: a disk may be nearly full.
  using Write = int (*)(const FaultRecord&, const std::string&);
  const std::pair<const char*, Write> files[] = {
      {"record.json", writeJson},  {"fault.html", writePage},     {"frames.log", writeCandump},
      {"cycles.csv", writeCycles}, {"decoded.csv", writeDecoded}, {"frames.asc", writeAsc}};
  for (const auto& [name, write] : files) {
    const std::string path = out.folder + "/" + name;
    try {
      if (const int reason = write(record, path)) {
        out.troubles.push_back(fmt::format("{}: not whole: {}", path, std::strerror(reason)));
      }
    } catch (const std::exception& e) {
      out.troubles.push_back(fmt::format("{}: {}", path, e.what()));
    }
  }
  try {
    if (const int reason = writeSums(out.folder)) {
      out.troubles.push_back(
          fmt::format("{}/{}: {}", out.folder, kRecordSums, std::strerror(reason)));
    }
  } catch (const std::exception& e) {
    out.troubles.push_back(fmt::format("{}/{}: {}", out.folder, kRecordSums, e.what()));
  }
  return out;
}

}  // namespace ballbot
