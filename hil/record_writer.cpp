#include "hil/record_writer.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr std::chrono::milliseconds kInterval{20};

const char* actionName(SafetyAction action) {
  switch (action) {
    case SafetyAction::kNoVoltage:
      return "no_voltage";
    case SafetyAction::kSwitchedOn:
      return "switched_on";
    case SafetyAction::kZeroTorque:
      return "zero_torque";
    case SafetyAction::kFollow:
      return "follow";
    case SafetyAction::kDamp:
      return "damp";
  }
  return "";
}

std::string header() {
  std::string line = "cycle,state,action,fault,wake_late_us,act_late_us,imu_count";
  for (const char* name : {"angle_rad", "velocity_rad_per_s", "torque_Nm", "sent_Nm", "status"}) {
    for (int i = 1; i <= kDriveCount; ++i) line += fmt::format(",{}_{}", name, i);
  }
  return line + "\n";
}

std::string lineOf(const CycleRecord& r) {
  std::string line =
      fmt::format("{},{},{},{},{:.1f},{:.1f},{}", r.cycle, toText(r.state), actionName(r.action),
                  toText(r.fault), 1e-3 * r.wake_late_ns, 1e-3 * r.act_late_ns, r.sample.imu_count);
  for (const DriveArray* a :
       {&r.sample.joint_angle, &r.sample.joint_velocity, &r.sample.joint_torque, &r.torque}) {
    for (const double v : *a) line += fmt::format(",{:.9g}", v);
  }
  for (const std::uint16_t word : r.statusword) line += fmt::format(",{:04X}", word);
  return line + "\n";
}

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
    std::fputs(header().c_str(), file_);
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
    const std::string line = lineOf(r);
    if (std::fwrite(line.data(), 1, line.size(), file_) == line.size()) continue;
    // A full disk ends the record, not the bench.
    sayLost();
    std::fclose(file_);
    file_ = nullptr;
  }
}

}  // namespace ballbot
