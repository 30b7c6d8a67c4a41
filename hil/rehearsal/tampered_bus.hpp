#pragma once

#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hil/can_bus.hpp"

namespace ballbot {

/// A bus with somebody in between, who may change, drop, double, hold back or add frames on their
/// way to the drives and to the master. What can go wrong on a wire, done on the wire. For
/// rehearsals and tests; it allocates.
class TamperedBus final : public CanBus {
 public:
  /// What becomes of a frame: everything that shall go on is put into `out`.
  using Rewrite = std::function<void(const CanFrame& frame, std::vector<CanFrame>& out)>;

  /// `inner` must outlive this.
  explicit TamperedBus(CanBus& inner) : inner_(inner) {}

  void onWayToDrives(Rewrite rewrite) { to_drives_.push_back(std::move(rewrite)); }
  void onWayToMaster(Rewrite rewrite) { to_master_.push_back(std::move(rewrite)); }
  /// As if another node had sent it: the drives and the master hear it.
  void intrude(const CanFrame& frame) {
    inner_.send(frame);
    inbox_.push_back(frame);
  }
  /// Told of every frame that the master sends, before it is acted on.
  void beforeSend(std::function<void(const CanFrame&)> observer) {
    observer_ = std::move(observer);
  }

  bool send(const CanFrame& frame) noexcept override {
    if (observer_) observer_(frame);
    bool sent = true;
    for (const CanFrame& f : through(to_drives_, frame)) sent = inner_.send(f) && sent;
    return sent;
  }
  bool receive(CanFrame& out) noexcept override {
    CanFrame frame;
    while (inbox_.empty() && inner_.receive(frame)) {
      for (const CanFrame& f : through(to_master_, frame)) inbox_.push_back(f);
    }
    if (inbox_.empty()) return false;
    out = inbox_.front();
    inbox_.pop_front();
    return true;
  }
  bool waitReadable(std::chrono::nanoseconds timeout) noexcept override {
    return !inbox_.empty() || inner_.waitReadable(timeout);
  }
  int descriptor() const noexcept override { return inner_.descriptor(); }
  bool isUp() const noexcept override { return inner_.isUp(); }
  const CanCounters& counters() const noexcept override { return inner_.counters(); }
  std::string describe() const override { return inner_.describe() + ", tampered with"; }

 private:
  static std::vector<CanFrame> through(const std::vector<Rewrite>& rewrites,
                                       const CanFrame& frame) {
    std::vector<CanFrame> now{frame}, next;
    for (const Rewrite& rewrite : rewrites) {
      next.clear();
      for (const CanFrame& f : now) rewrite(f, next);
      now.swap(next);
    }
    return now;
  }

  CanBus& inner_;
  std::vector<Rewrite> to_drives_, to_master_;
  std::deque<CanFrame> inbox_;
  std::function<void(const CanFrame&)> observer_;
};

}  // namespace ballbot
