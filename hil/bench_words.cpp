// What a bench says to people.
#include <fmt/format.h>

#include "hil/bench.hpp"

namespace ballbot {

std::string Bench::faultText() const {
  const BenchFault fault = safety_.fault();
  if (fault == BenchFault::kNone) return "";
  std::string text = toText(fault);
  if (latched_.drive >= 0 && latched_.drive < kDriveCount) {
    text += ": " + config_.drives[static_cast<std::size_t>(latched_.drive)].name;
  }
  switch (fault) {
    case BenchFault::kNodeTrouble:
      return text + (latched_.drive == BenchMaster::kImuLink ? ": IMU" : "") + ": " +
             master_.link(latched_.drive).troubleText();
    case BenchFault::kDriveFault:
    case BenchFault::kDriveDroppedOut:
    case BenchFault::kDriveUnbidden: {
      const auto word = static_cast<std::uint16_t>(latched_.value);
      return fmt::format("{} ({}, statusword {:04X})", text, toText(driveState(word)), word);
    }
    case BenchFault::kDriveTransition:
      if (latched_.drive < 0) return text;
      return fmt::format("{} (statusword {:04X})", text,
                         static_cast<std::uint16_t>(latched_.value));
    case BenchFault::kCommandNotFinite:
    case BenchFault::kSensorNotFinite:
    case BenchFault::kNodeTwin:
    case BenchFault::kBusDown:
      return text;
    case BenchFault::kForeignFrame:
      return fmt::format("{} (identifier {:03X})", text, static_cast<unsigned>(latched_.value));
    case BenchFault::kParameterChanged:
      return text + ": " + parameters_.text();
    default:
      if (latched_.drive == BenchMaster::kImuLink) {
        return text + ": " + master_.link(latched_.drive).troubleText();
      }
      return fmt::format("{} ({:.4g}, limit {:.4g})", text, latched_.value, latched_.limit);
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
