// What a bench says to people.
#include <fmt/format.h>

#include "hil/bench.hpp"

namespace ballbot {

std::string Bench::faultText() const {
  return safety_.fault() == BenchFault::kNone ? "" : textOf(latched_);
}

std::string Bench::textOf(const Finding& found) const {
  const BenchFault fault = found.fault;
  std::string text = toText(fault);
  if (found.drive >= 0 && found.drive < kDriveCount) {
    text += ": " + config_.drives[static_cast<std::size_t>(found.drive)].name;
  }
  switch (fault) {
    case BenchFault::kNodeTrouble:
      return text + (found.drive == BenchMaster::kImuLink ? ": IMU" : "") + ": " +
             master_.link(found.drive).troubleText();
    case BenchFault::kDriveFault:
    case BenchFault::kDriveDroppedOut:
    case BenchFault::kDriveUnbidden: {
      const auto word = static_cast<std::uint16_t>(found.value);
      return fmt::format("{} ({}, statusword {:04X})", text, toText(driveState(word)), word);
    }
    case BenchFault::kDriveTransition:
      if (found.drive < 0) return text;
      return fmt::format("{} (statusword {:04X})", text, static_cast<std::uint16_t>(found.value));
    case BenchFault::kCommandNotFinite:
    case BenchFault::kSensorNotFinite:
    case BenchFault::kNodeTwin:
    case BenchFault::kBusDown:
      return text;
    case BenchFault::kForeignFrame:
      return fmt::format("{} (identifier {:03X})", text, static_cast<unsigned>(found.value));
    case BenchFault::kParameterChanged:
      return text + ": " + parameters_.text();
    default:
      if (found.drive == BenchMaster::kImuLink) {
        return text + ": " + master_.link(found.drive).troubleText();
      }
      return fmt::format("{} ({:.4g}, limit {:.4g})", text, found.value, found.limit);
  }
}

std::string Bench::lastWord() const {
  if (torqueIsOff()) return "";
  std::string text;
  for (int i = 0; i < kDriveCount; ++i) {
    if (way_down_.underWay() && !way_down_.isDoubtful(i)) continue;
    const DriveConfig& d = config_.drives[static_cast<std::size_t>(i)];
    const std::uint16_t word = master_.drive(i).statusword;
    text += fmt::format(
        "TORQUE MAY STILL BE ON: node {} ({}, bus {}) has not said that it is off, its last "
        "statusword was {:04X} ({}), the last it was told was {}. Pull {} now.\n",
        d.node, d.name, d.bus, word, toText(driveState(word)), toText(way_down_.stage(i)),
        d.off_switch);
  }
  return text;
}

}  // namespace ballbot
