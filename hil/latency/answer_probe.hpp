#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hil/bench_config.hpp"
#include "hil/frame_bits.hpp"
#include "hil/jitter_histogram.hpp"

namespace ballbot {

/// Tells apart where the time between SYNC and the answers goes, from the times at which this
/// program sent and took frames. For the cycle: neither allocates, locks nor throws.
///
///   answer of a node  =  wire  +  shared  +  the node's own
///
/// wire    bits of SYNC and of all frames of that bus up to the node's last PDO, without stuff
/// bits:
///         a lower bound, because a bus carries one frame at a time
/// shared  what the quickest node of the bus took beyond the wire in that cycle: adapter, driver,
///         this program's wake-up, and the quickest drive's own reaction, which no clock at this
///         end tells from the adapter's
/// own     what a node took beyond that
///
/// Answers that come sooner than a wire of the configured rate could carry them have come over
/// none: an emulated bus. From then on nothing is taken off for it.
class AnswerProbe {
 public:
  static constexpr int kNodes = kDriveCount + 1;  ///< six drives, the IMU

  explicit AnswerProbe(const BenchConfig& config);

  /// Every frame that passes, in order. @param sent  by this master
  void onFrame(std::int64_t time_ns, int bus, const CanFrame& frame, bool sent) noexcept;
  /// All answers of a cycle are in, or are not awaited any more.
  void endCycle() noexcept;

  struct Bus {
    JitterHistogram wire;     ///< up to the last answer, at least
    JitterHistogram answers;  ///< from SYNC handed over to the last answer taken
    JitterHistogram shared;   ///< see above
    bool has_wire = true;     ///< false: answers came sooner than one could carry them
  };
  struct Node {
    JitterHistogram answer;  ///< from SYNC handed over to its last PDO taken
    JitterHistogram own;     ///< beyond the quickest of its bus
  };
  const std::vector<Bus>& buses() const noexcept { return buses_; }
  /// In the order of the drives; the last one is the IMU.
  const std::array<Node, kNodes>& nodes() const noexcept { return nodes_; }

 private:
  struct BusNow {
    std::int64_t sync_ns = 0;
    WireBits bits;
    bool waiting = false;
  };
  struct NodeNow {
    std::uint8_t missing = 0;  ///< PDOs of this cycle that have not come, a bit each
    std::int64_t answer_ns = 0, wire_ns = 0;
    bool complete = false;
  };
  void onSync(std::int64_t time_ns, std::size_t bus) noexcept;
  void onPdo(std::int64_t time_ns, std::size_t bus, std::size_t node, int pdo) noexcept;
  void onAnswers(std::size_t bus) noexcept;
  std::int64_t wireNs(std::size_t bus, const WireBits& bits) const noexcept;

  std::vector<CanBusSettings> rates_;
  std::array<int, kNodes> bus_of_{};
  std::array<std::uint32_t, kNodes> id_of_{};
  std::array<std::uint8_t, kNodes> all_pdos_{};
  std::vector<BusNow> now_;
  std::array<NodeNow, kNodes> answers_{};
  std::vector<Bus> buses_;
  std::array<Node, kNodes> nodes_{};
};

}  // namespace ballbot
