#include "hil/bus_budget.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "hil/drive_setup.hpp"
#include "hil/frame_bits.hpp"
#include "hil/shared_outputs.hpp"

namespace ballbot {
namespace {

constexpr std::uint8_t kSdoBytes = 8, kHeartbeatBytes = 1;

/// Adds up the time of one bus.
class BusTime {
 public:
  BusTime(const BenchConfig& config, const CanBusSettings& bus) : config_(config), bus_(bus) {}

  void inEveryCycle(std::uint8_t bytes) {
    ++budget_.frames_per_cycle;
    every(config_.cycleSeconds(), bytes);
  }
  /// @param times  a frame of that many in so long a time [s]
  void every(double seconds, std::uint8_t bytes, double times = 1) {
    CanFrame frame;
    frame.size = bytes;
    frame.flexible = frame.fast = bus_.flexible();
    const FrameBits bits = bitsOf(frame);
    const auto share = [&](const WireBits& b) {
      return times * 1e-6 * b.microseconds(bus_.bitrate_kbps, bus_.data_bitrate_kbps) / seconds;
    };
    budget_.nominal += share(bits.nominal);
    budget_.worst += share(bits.worst);
  }
  const BusBudget& budget() const { return budget_; }

 private:
  const BenchConfig& config_;
  const CanBusSettings& bus_;
  BusBudget budget_;
};

void addNode(BusTime& time, const BenchConfig& config) {
  time.every(1e-3 * config.drive_heartbeat_ms, kHeartbeatBytes);
}

void addDrive(BusTime& time, const BenchConfig& config) {
  if (!config.shared_outputs) {
    for (const PdoMapping& map : config.outputs) time.inEveryCycle(map.frameBytes());
  }
  for (const PdoMapping& map : config.inputs) time.inEveryCycle(map.frameBytes());
  addNode(time, config);
  if (config.safety.read_back_cycles == 0) return;
  // Question and answer, of one drive after another.
  time.every(config.safety.read_back_cycles * config.cycleSeconds(), kSdoBytes, 2.0 / kDriveCount);
}

void addImu(BusTime& time, const BenchConfig& config) {
  if (config.flexible()) {
    time.inEveryCycle(imuMapping().frameBytes());
  } else {
    time.inEveryCycle(8);
    time.inEveryCycle(6);
  }
  addNode(time, config);
}

}  // namespace

std::vector<BusBudget> busBudget(const BenchConfig& config) {
  std::vector<BusBudget> out;
  for (std::size_t b = 0; b < config.buses.size(); ++b) {
    BusTime time(config, config.buses[b].settings);
    time.inEveryCycle(0);  // SYNC
    time.every(1e-3 * config.master_heartbeat_ms, kHeartbeatBytes);
    for (const DriveConfig& drive : config.drives) {
      if (drive.bus == static_cast<int>(b)) addDrive(time, config);
    }
    if (config.imu.bus == static_cast<int>(b)) addImu(time, config);
    if (config.shared_outputs) {
      const CanFrame frame = sharedFrame(config, static_cast<int>(b));
      if (frame.size > 0) time.inEveryCycle(frame.size);
    }
    out.push_back(time.budget());
  }
  return out;
}

void requireRoom(const BenchConfig& config) {
  if (config.stepped) return;  // SYNC waits for the bus
  const std::vector<BusBudget> budgets = busBudget(config);
  for (std::size_t b = 0; b < budgets.size(); ++b) {
    if (budgets[b].nominal <= 1) continue;
    throw InputError(
        fmt::format("bus {} ({}) would need {:.0f} % of its time: {} frames in every cycle of "
                    "{:.6g} ms. Spread the "
                    "drives over two buses, map less, take CAN FD (`fd:`), or a longer cycle_us",
                    b, config.buses[b].address, 100 * budgets[b].nominal,
                    budgets[b].frames_per_cycle, 1e3 * config.cycleSeconds()));
  }
}

}  // namespace ballbot
