#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "ballbot_msgs/actuator_command.hpp"
#include "ballbot_msgs/added_values.hpp"
#include "ballbot_msgs/plan_report.hpp"
#include "ballbot_msgs/sensor_frame.hpp"
#include "ballbot_msgs/state_estimate.hpp"
#include "ballbot_msgs/tick_digests.hpp"
#include "ballbot_msgs/truth_frame.hpp"
#include "core/digest.hpp"
#include "cosim/event_log.hpp"
#include "cosim/tick.hpp"
#include "messages/channels.hpp"

namespace ballbot {

class ConfigVisitor;

/// What goes into the log, how often. A message is logged at the first event at or after each
/// multiple of its channel's period; period zero logs every one, a negative period none.
/// Recording never changes the run.
struct RecorderOptions {
  std::string log_path;            ///< empty: no log, digest only
  SimDuration sensors{2'500'000};  ///< the estimator's period: what it consumed
  SimDuration truth{2'500'000};
  SimDuration estimate{2'500'000};
  SimDuration plan{0};
  SimDuration command{2'500'000};

  /// All but `log_path`.
  void describe(ConfigVisitor& v);
};

/// Writes the log of a run and computes its trajectory digest. The digest covers every message of
/// every event, whatever the log keeps.
class Recorder {
 public:
  /// @throw OutputError if the log cannot be created.
  explicit Recorder(RecorderOptions options);

  /// @throw OutputError if the disk is full; what was logged stays readable.
  void record(const Tick& tick);
  /// Completes the log. A recorder that is destroyed without leaves a readable log, too.
  void close();

  /// 32 hexadecimal digits; equal for runs that did the same at every event.
  std::string trajectoryDigest() const { return digest_.hex(); }
  /// Of the log's bytes, once it is complete; empty without a log.
  std::string logDigest() const { return log_ ? log_->digest() : ""; }
  std::int64_t bytesWritten() const { return log_ ? log_->bytesWritten() : 0; }

 private:
  /// @return whether it was logged
  template <typename Message>
  bool take(Channel channel, SimTime time, SimDuration period, const Message& message);
  void takeAdded(AddedTo frame, const Tick& tick, bool log);
  void writeAdded(AddedTo frame, SimTime time);
  void beginTick(const Tick& tick);
  void addHash(Channel channel, std::uint64_t hash);
  void writeDigests();

  RecorderOptions options_;
  std::unique_ptr<EventLogWriter> log_;
  Digest digest_;
  std::array<SimTime, kChannelCount> next_due_{};
  SimTime next_flush_{}, last_time_{};
  ballbot_msgs::sensor_frame sensors_{};
  ballbot_msgs::truth_frame truth_{};
  ballbot_msgs::actuator_command command_{};
  ballbot_msgs::state_estimate estimate_{};
  ballbot_msgs::plan_report plan_{};
  ballbot_msgs::tick_digests tick_digests_{};
  ballbot_msgs::added_values added_{};
  PerAddedTo<bool> named_;  ///< the lists of what was added are written
  Bytes bytes_, digest_room_;
};

}  // namespace ballbot
