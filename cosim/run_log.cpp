// A whole log, typed: what LogReader gives, sorted by channel, and whether it can be believed.
#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "cosim/log_reader.hpp"
#include "messages/convert.hpp"

namespace ballbot {
namespace {

/// Simulated time that the recorder stamps the event of a message with [us].
template <typename Message>
std::int64_t stampOf(const Message& message) {
  return message.sim_time_ns / 1000;
}
std::int64_t stampOf(const ballbot_msgs::tick_digests& message) {
  const std::int64_t offset = message.offset_ns.empty() ? 0 : message.offset_ns.back();
  // Unsigned: what a stranger wrote may lie anywhere.
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(message.first_time_ns) +
                                   static_cast<std::uint64_t>(offset)) /
         1000;
}

template <typename Message, typename Frame>
bool unpack(const Message& message, Frame& out) {
  return fromMessage(message, out);
}
bool unpack(ballbot_msgs::added_values& message, ballbot_msgs::added_values& out) {
  out = std::move(message);
  return true;
}
bool unpack(ballbot_msgs::tick_digests& message, ballbot_msgs::tick_digests& out) {
  out = std::move(message);
  return true;
}
bool unpack(const ballbot_msgs::actuator_command& message, RecordedCommand& out) {
  out.time = simTimeFromNs(message.sim_time_ns);
  return fromMessage(message, out.command);
}

bool isTypeOfRun(std::int64_t fingerprint) {
  const std::int64_t known[] = {
      ballbot_msgs::sensor_frame::getHash(),     ballbot_msgs::truth_frame::getHash(),
      ballbot_msgs::state_estimate::getHash(),   ballbot_msgs::plan_report::getHash(),
      ballbot_msgs::actuator_command::getHash(), ballbot_msgs::tick_digests::getHash(),
      ballbot_msgs::added_values::getHash()};
  return std::find(std::begin(known), std::end(known), fingerprint) != std::end(known);
}

std::optional<AddedTo> addedChannel(const std::string& name) {
  for (const AddedTo frame : kAllAddedTo) {
    if (name == addedChannelName(frame)) return frame;
  }
  return std::nullopt;
}

class RunLogReader {
 public:
  explicit RunLogReader(const std::string& path) : reader_(path) {}

  RunLog read() {
    while (reader_.next(event_)) take();
    log_.cut_off = reader_.cutOff();
    addDamage(reader_.damage());
    for (const auto& [channel, stamps] : stamps_) {
      // A channel that never agrees, as in logs of LCM's own logger, has the clock on the wall.
      if (stamps.wrong.places < stamps.right) addDamage(stamps.wrong);
    }
    return std::move(log_);
  }

 private:
  struct Stamps {
    std::int64_t right = 0;
    LogDamage wrong;
  };

  void take() {
    using namespace ballbot_msgs;
    if (event_.channel == channelName(Channel::kSensors)) {
      keep<sensor_frame>(log_.sensors);
    } else if (event_.channel == channelName(Channel::kTruth)) {
      keep<truth_frame>(log_.truth);
    } else if (event_.channel == channelName(Channel::kEstimate)) {
      keep<state_estimate>(log_.estimates);
    } else if (event_.channel == channelName(Channel::kPlan)) {
      keep<plan_report>(log_.plans);
    } else if (event_.channel == channelName(Channel::kCommand)) {
      keep<actuator_command>(log_.commands);
    } else if (const auto frame = addedChannel(event_.channel)) {
      keepAdded(log_.added[*frame]);
    } else if (event_.channel == kTickDigestsChannel) {
      keep<tick_digests>(log_.digests);
    } else if (isTypeOfRun(fingerprint(event_.data.data(), event_.data.size()))) {
      lose("a message of a run stands on a channel that no run has");
    } else if (++log_.unknown == 1) {
      log_.unknown_channel = event_.channel;
    }
  }

  template <typename Message, typename Kept>
  void keep(std::vector<Kept>& list) {
    Message message{};
    if (!event_.decode(message)) {
      lose(fmt::format("its {} message is damaged", event_.channel));
      return;
    }
    Stamps& stamps = stamps_[event_.channel];
    if (stampOf(message) == event_.timestamp_us) {
      ++stamps.right;
    } else {
      stamps.wrong.add(reader_.eventBegin(),
                       fmt::format("its {} message is stamped {} us and is of {} us",
                                   event_.channel, event_.timestamp_us, stampOf(message)));
    }
    list.emplace_back();
    if (unpack(message, list.back())) return;
    list.pop_back();
    lose(fmt::format("its {} message is of a robot with another number of joints", event_.channel));
  }

  void keepAdded(AddedRecord& record) {
    std::vector<ballbot_msgs::added_values> messages;
    keep<ballbot_msgs::added_values>(messages);
    if (messages.empty()) return;
    const ballbot_msgs::added_values& m = messages.front();
    if (!m.name.empty()) {
      record.list.push_back({m.name, m.unit, m.words});
      return;
    }
    if (m.value.size() != record.list.size()) {
      return lose(fmt::format("its {} message has {} values, and {} are named", event_.channel,
                              m.value.size(), record.list.size()));
    }
    record.times.push_back(simTimeFromNs(m.sim_time_ns));
    record.rows.push_back(m.value);
  }

  void lose(const std::string& what) {
    log_.damage.add(reader_.eventBegin(), what);
    ++log_.damage.lost_events;
  }

  void addDamage(const LogDamage& more) {
    if (more.none()) return;
    log_.damage.add(more.first_byte, more.first);
    log_.damage.places += more.places - 1;
    log_.damage.lost_events += more.lost_events;
    log_.damage.lost_bytes += more.lost_bytes;
  }

  LogReader reader_;
  LogEvent event_;
  RunLog log_;
  std::map<std::string, Stamps> stamps_;  // by channel
};

}  // namespace

RunLog readRunLog(const std::string& path) { return RunLogReader(path).read(); }

}  // namespace ballbot
