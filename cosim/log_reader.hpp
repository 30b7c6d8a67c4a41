#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "ballbot_msgs/actuator_command.hpp"
#include "ballbot_msgs/plan_report.hpp"
#include "ballbot_msgs/sensor_frame.hpp"
#include "ballbot_msgs/state_estimate.hpp"
#include "ballbot_msgs/tick_digests.hpp"
#include "ballbot_msgs/truth_frame.hpp"
#include "messages/channels.hpp"
#include "messages/wire.hpp"

namespace ballbot {

/// One event of an LCM log.
struct LogEvent {
  std::int64_t number = 0;
  std::int64_t timestamp_us = 0;  ///< simulated time [us]
  std::string channel;
  Bytes data;

  /// False if the data is not one undamaged message of this type.
  template <typename Message>
  bool decode(Message& out) const {
    return decodeMessage(data.data(), data.size(), out);
  }
};

/// Reads an LCM event log from its beginning. A log that was cut off, at any byte, is readable up
/// to its last whole event.
class LogReader {
 public:
  /// @throw InputError if there is no such file or it is no LCM event log.
  explicit LogReader(const std::string& path);

  /// False at the end. @throw InputError at bytes that cannot be an event.
  bool next(LogEvent& out);
  /// After next() returned false: did the file end in the middle of an event?
  bool cutOff() const { return cut_off_; }

 private:
  bool take(void* to, std::size_t size);

  std::string path_;
  std::ifstream file_;
  std::int64_t position_ = 0, event_begin_ = 0;  // [byte]
  bool cut_off_ = false;
};

/// A whole log in memory, typed, in the order of time.
struct RunLog {
  std::vector<ballbot_msgs::sensor_frame> sensors;
  std::vector<ballbot_msgs::truth_frame> truth;
  std::vector<ballbot_msgs::state_estimate> estimates;
  std::vector<ballbot_msgs::plan_report> plans;
  std::vector<ballbot_msgs::actuator_command> commands;
  std::vector<ballbot_msgs::tick_digests> digests;
  std::int64_t unknown = 0;  ///< events of other channels, or damaged
  bool cut_off = false;
};
/// @throw InputError as LogReader.
RunLog readRunLog(const std::string& path);

}  // namespace ballbot
