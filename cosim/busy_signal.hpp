#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>

namespace ballbot {

/// How a participant that is long at work on one request lets its master know that it lives.
/// Whoever serves it connects the signal; the participant tells it, as often as it likes, what it
/// is doing.
class BusySignal {
 public:
  static constexpr std::chrono::milliseconds kInterval{500};  ///< tells more often are dropped

  void connect(std::function<void(const std::string&)> send) { send_ = std::move(send); }
  /// @param doing  "setting up the drives, 12 of 410 transfers done"
  void tell(const std::string& doing) {
    const auto now = std::chrono::steady_clock::now();
    if (!send_ || now - last_ < kInterval) return;
    last_ = now;
    send_(doing);
  }

 private:
  std::function<void(const std::string&)> send_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace ballbot
