#include "hil/record/frame_words.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "hil/canopen_codec.hpp"
#include "hil/record/object_words.hpp"
#include "hil/record/sdo_words.hpp"

namespace ballbot {
namespace {

const DriveConfig* driveAt(const BenchConfig& config, int bus, int node) {
  for (const DriveConfig& d : config.drives) {
    if (d.bus == bus && d.node == node) return &d;
  }
  return nullptr;
}

std::string nodeName(const BenchConfig& config, int bus, int node) {
  if (node == 0) return "all nodes";
  if (node == config.master_node) return "master";
  if (const DriveConfig* d = driveAt(config, bus, node)) return d->name;
  if (node == config.imu.node && bus == config.imu.bus) return "IMU";
  return fmt::format("node {}", node);
}

std::string bytesText(const CanFrame& f) {
  if (f.size == 0) return "";
  std::string text = "bytes";
  for (std::size_t i = 0; i < f.size; ++i) text += fmt::format(" {:02X}", f.data[i]);
  return text;
}

std::string nmtText(const CanFrame& f) {
  if (f.size != 2) return "no NMT command: its length is not 2";
  switch (static_cast<NmtCommand>(f.data[0])) {
    case NmtCommand::kStart:
      return "start";
    case NmtCommand::kStop:
      return "stop";
    case NmtCommand::kPreOperational:
      return "enter pre-operational";
    case NmtCommand::kResetNode:
      return "reset node";
    case NmtCommand::kResetCommunication:
      return "reset communication";
  }
  return fmt::format("unknown command {:02X}", f.data[0]);
}

std::string emergencyText(const CanFrame& f) {
  const auto e = readEmergency(f);
  if (!e) return "no emergency: its length is not 8";
  return fmt::format("{:04X} ({}), error register {:02X}", e->code, errorCodeText(e->code),
                     e->error_register);
}

std::string mappedText(const CanFrame& f, const std::vector<PdoMapping>& maps, std::size_t number,
                       const DriveConfig& drive) {
  if (number >= maps.size()) return "not mapped: " + bytesText(f);
  if (f.size != maps[number].bytes()) {
    return fmt::format("{} bytes, the mapping has {}: {}", f.size, maps[number].bytes(),
                       bytesText(f));
  }
  std::string text;
  std::size_t offset = 0;
  for (const PdoEntry& entry : maps[number].entries()) {
    const std::size_t bytes = entry.bits / 8U;
    if (!text.empty()) text += ", ";
    text += objectText(entry.object, &f.data[offset], bytes, &drive);
    offset += bytes;
  }
  return text;
}

std::string imuText(const CanFrame& f, std::size_t number, const ImuConfig& imu) {
  const std::size_t expected = number == 0 ? 8 : 6;
  if (number > 1 || f.size != expected) return "unknown layout: " + bytesText(f);
  const double unit = number == 0 ? imu.accel_resolution : imu.gyro_resolution;
  const auto axis = [&](std::size_t i) {
    return unit * static_cast<double>(getSigned(&f.data[2 * i], 2));
  };
  std::string text = fmt::format("{} x {:.5g}, y {:.5g}, z {:.5g} {}",
                                 number == 0 ? "specific force" : "angular rate", axis(0), axis(1),
                                 axis(2), number == 0 ? "m/s^2" : "rad/s");
  if (number == 0) text += fmt::format(", sample {}", getLittleEndian(&f.data[6], 2));
  return text;
}

/// The PDO of these identifiers that a function code belongs to, from 0; or -1.
int pdoOf(std::uint32_t function, const std::array<std::uint32_t, 4>& cobs) {
  const auto found = std::find(cobs.begin(), cobs.end(), function);
  return found == cobs.end() ? -1 : static_cast<int>(found - cobs.begin());
}

struct Reader {
  const CanFrame& f;
  const BenchConfig& config;
  int bus;

  FrameWords read() const {
    FrameWords w;
    const std::uint32_t function = f.id & 0x780U;
    w.node = f.extended ? 0 : static_cast<int>(f.id & 0x7FU);
    const DriveConfig* drive = driveAt(config, bus, w.node);
    if (f.extended) {
      w.who = "nobody";
      w.service = "29-bit identifier";
      w.meaning = bytesText(f);
      return w;
    }
    if (f.id == kCobNmt) {
      w.node = f.size == 2 ? f.data[1] : 0;
      w.service = "NMT";
      w.meaning = nmtText(f);
    } else if (f.id == kCobSync) {
      w.service = "SYNC";
      w.meaning = bytesText(f);
    } else if (function == kCobEmergency) {
      w.service = "EMCY";
      w.meaning = emergencyText(f);
    } else if (function == kCobHeartbeat) {
      w.service = "heartbeat";
      const auto beat = readHeartbeat(f);
      w.meaning = beat ? toText(beat->state) : "no state: " + bytesText(f);
    } else if (function == kCobSdoToServer || function == kCobSdoToClient) {
      const bool request = function == kCobSdoToServer;
      w.service = request ? "SDO request" : "SDO answer";
      w.meaning = sdoText(f, request, drive);
    } else if (const int t = pdoOf(function, kCobTpdo); t >= 0) {
      w.service = fmt::format("TPDO{}", t + 1);
      const bool imu = w.node == config.imu.node && bus == config.imu.bus;
      const auto n = static_cast<std::size_t>(t);
      w.meaning = drive != nullptr ? mappedText(f, config.inputs, n, *drive)
                  : imu            ? imuText(f, n, config.imu)
                                   : bytesText(f);
    } else if (const int r = pdoOf(function, kCobRpdo); r >= 0) {
      w.service = fmt::format("RPDO{}", r + 1);
      w.meaning = drive != nullptr
                      ? mappedText(f, config.outputs, static_cast<std::size_t>(r), *drive)
                      : bytesText(f);
    } else {
      w.service = "unknown";
      w.meaning = bytesText(f);
    }
    if (f.remote) {
      w.service += ", remote";
      w.meaning = "asks for the frame";
    }
    w.who = nodeName(config, bus, w.node);
    return w;
  }
};

}  // namespace

FrameWords wordsOf(const RecordedFrame& frame, const BenchConfig& config) {
  FrameWords w = Reader{frame.frame, config, frame.bus}.read();
  if (!frame.sent && isMasters(config, frame.bus, frame.frame)) {
    w.meaning = "FROM SOMEBODY ELSE" + (w.meaning.empty() ? "" : ": " + w.meaning);
  }
  if (frame.refused) w.meaning = "NOT SENT" + (w.meaning.empty() ? "" : ": " + w.meaning);
  return w;
}

}  // namespace ballbot
