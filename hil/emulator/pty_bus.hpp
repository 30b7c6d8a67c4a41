#pragma once

#include <deque>
#include <optional>
#include <string>

#include "hil/can_bus.hpp"
#include "hil/emulator/link_claim.hpp"
#include "hil/emulator/slcan_adapter.hpp"

namespace ballbot {

/// The emulated bench's end of a CAN bus: a pseudo terminal with an slcan adapter behind it.
/// Whoever opens path() finds an adapter there. Unlike the master's buses it may allocate.
class PtyBus final : public CanBus {
 public:
  /// @param link  symbolic link to make, so that the name stays the same from run to run; empty:
  ///              none. Replaces a link that nobody serves any more, never a file.
  /// @throw OutputError if there is no pty or the link cannot be made; InputError if another
  ///        process serves the link.
  /// @param flexible  whether the adapter has CAN FD
  explicit PtyBus(std::string link, bool flexible = false);
  ~PtyBus() override;
  PtyBus(const PtyBus&) = delete;
  PtyBus& operator=(const PtyBus&) = delete;

  bool send(const CanFrame& frame) noexcept override;
  bool receive(CanFrame& out) noexcept override;
  bool waitReadable(std::chrono::nanoseconds timeout) noexcept override;
  int descriptor() const noexcept override { return master_; }
  bool isUp() const noexcept override { return master_ >= 0; }
  const CanCounters& counters() const noexcept override { return counters_; }
  std::string describe() const override { return "emulated slcan adapter at " + path(); }

  /// What to open: the link if there is one.
  const std::string& path() const { return link_.empty() ? device_ : link_; }
  const SlcanAdapter& adapter() const { return adapter_; }

 private:
  void read();
  void flush() noexcept;

  std::optional<LinkClaim> claim_;
  std::string device_, link_;
  int master_ = -1, slave_ = -1;
  SlcanAdapter adapter_;
  std::string output_;
  std::deque<CanFrame> arrived_;
  CanCounters counters_;
};

}  // namespace ballbot
