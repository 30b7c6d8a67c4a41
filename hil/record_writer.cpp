#include "hil/record_writer.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>

#include <fmt/format.h>

#include "core/error.hpp"
#include "hil/cycle_csv.hpp"

namespace ballbot {
namespace {

constexpr std::chrono::milliseconds kInterval{20};

void sayLost() {
  std::fprintf(stderr, "the record of cycles ends early: %s\n", std::strerror(errno));
}

}  // namespace

RecordWriter::RecordWriter(SpscRing<CycleRecord>& records, const std::string& path)
    : records_(records) {
  if (!path.empty()) {
    file_ = std::fopen(path.c_str(), "w");
    if (file_ == nullptr) {
      throw OutputError(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
    }
    std::fputs(cycleCsvHeader().c_str(), file_);
  }
  thread_ = std::thread([this] { run(); });
}

RecordWriter::~RecordWriter() {
  stop_ = true;
  thread_.join();
  if (file_ != nullptr && std::fclose(file_) != 0) sayLost();
}

void RecordWriter::run() {
  while (!stop_) {
    drain();
    std::this_thread::sleep_for(kInterval);
  }
  drain();
}

void RecordWriter::drain() {
  CycleRecord r;
  while (records_.pop(r)) {
    if (file_ == nullptr) continue;
    const std::string line = cycleCsvLine(r);
    if (std::fwrite(line.data(), 1, line.size(), file_) == line.size()) continue;
    // A full disk ends the record, not the bench.
    sayLost();
    std::fclose(file_);
    file_ = nullptr;
  }
}

}  // namespace ballbot
