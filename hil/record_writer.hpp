#pragma once

#include <atomic>
#include <cstdio>
#include <string>
#include <thread>

#include "hil/bench.hpp"
#include "hil/spsc_ring.hpp"

namespace ballbot {

/// Empties the record of a real-time loop into a CSV file, from a thread of its own, so that the
/// loop never waits for a disk.
class RecordWriter {
 public:
  /// @param path  empty: the records are thrown away
  /// @throw OutputError if the file cannot be written.
  RecordWriter(SpscRing<CycleRecord>& records, const std::string& path);
  /// Writes what is left and ends.
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

 private:
  void run();
  void drain();

  SpscRing<CycleRecord>& records_;
  std::FILE* file_ = nullptr;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ballbot
