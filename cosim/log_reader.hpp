#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ballbot_msgs/tick_digests.hpp"
#include "messages/channels.hpp"
#include "messages/wire.hpp"
#include "model/added_signals.hpp"
#include "model/reports.hpp"
#include "model/signals.hpp"
#include "model/truth.hpp"

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

/// What of a log is not as it was written.
struct LogDamage {
  std::int64_t places = 0;
  std::int64_t lost_events = 0;  ///< at least so many are not there or cannot be believed
  std::int64_t lost_bytes = 0;   ///< that belong to no event
  std::int64_t first_byte = 0;   ///< where the first place begins
  std::string first;             ///< what is wrong there

  bool none() const { return places == 0; }
  void add(std::int64_t byte, const std::string& what);
  /// "damaged at byte 1234: no event begins there; 2 places, 3 events lost, 800 bytes passed over"
  std::string text() const;
};

/// Reads an LCM event log from its beginning, as far as it reached when it was opened. A log that
/// was cut off, at any byte, is readable up to its last whole event; after bytes that are no event
/// it is read on from the next one.
class LogReader {
 public:
  /// @throw InputError if there is no such file.
  explicit LogReader(const std::string& path);
  ~LogReader();
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;

  /// False at the end. @throw InputError if the file holds bytes and no event.
  bool next(LogEvent& out);
  /// Where the event that next() gave begins [byte].
  std::int64_t eventBegin() const { return event_begin_; }
  /// After next() returned false: did the file end in the middle of an event?
  bool cutOff() const { return cut_off_; }
  /// What was wrong so far with the events themselves; their messages are the caller's.
  const LogDamage& damage() const { return damage_; }

 private:
  struct Header;
  const std::uint8_t* bytesAt(std::int64_t begin, std::size_t size);
  std::size_t readyFrom(std::int64_t begin) const;
  bool isSync(std::int64_t begin);
  bool isEvent(std::int64_t begin, Header& header);
  bool endsWithin(std::int64_t begin);
  void skipToEvent();
  void checkNumber(std::int64_t number, std::int64_t passed_over);

  std::string path_;
  int file_ = -1;
  std::int64_t size_ = 0, position_ = 0, event_begin_ = 0;  // [byte]
  std::vector<std::uint8_t> window_;                        // bytes of the file from window_begin_
  std::int64_t window_begin_ = 0;
  std::int64_t next_number_ = 0;
  bool cut_off_ = false;
  LogDamage damage_;
};

struct RecordedCommand {
  SimTime time{};  ///< from which it acts
  ActuatorCommand command;
};

/// What was added to a frame, over time.
struct AddedRecord {
  std::vector<AddedSignal> list;
  std::vector<SimTime> times;
  std::vector<std::vector<double>> rows;  ///< one value for each of the list
};

/// A whole log in memory, typed, in the order of time.
struct RunLog {
  std::vector<SensorFrame> sensors;
  std::vector<TruthFrame> truth;
  std::vector<EstimateFrame> estimates;
  std::vector<PlanFrame> plans;
  std::vector<RecordedCommand> commands;
  PerAddedTo<AddedRecord> added;
  std::vector<ballbot_msgs::tick_digests> digests;
  std::int64_t unknown = 0;     ///< events of other channels
  std::string unknown_channel;  ///< the first of them
  bool cut_off = false;
  LogDamage damage;

  /// Nothing that a run records.
  bool empty() const {
    return sensors.empty() && truth.empty() && estimates.empty() && plans.empty() &&
           commands.empty();
  }
};
/// @throw InputError as LogReader.
RunLog readRunLog(const std::string& path);

}  // namespace ballbot
