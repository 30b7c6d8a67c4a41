#include "cosim/recorder.hpp"

#include "core/config_visitor.hpp"
#include "messages/convert.hpp"
#include "messages/digest_form.hpp"

namespace ballbot {
namespace {

// So often, in simulated time, the log is handed to the operating system.
constexpr SimDuration kFlushPeriod{100'000'000};
constexpr SimDuration kDigestPeriod{10'000'000};
// More would not fit into one message, should events be that dense.
constexpr std::int32_t kMaxTicksPerMessage = 40;

SimTime nextMultiple(SimTime t, SimDuration period) {
  return SimTime{(t.time_since_epoch() / period + 1) * period};
}

// Never 0, which stands for no message.
std::int32_t shortHash(std::uint64_t hash) {
  const auto low = static_cast<std::int32_t>(hash);
  return low == 0 ? 1 : low;
}

}  // namespace

void RecorderOptions::describe(ConfigVisitor& v) {
  const Range any{-1, kInf};
  v.duration(may("sensors_period_ms", "from one recorded sensor frame to the next; 0 all, -1 none"),
             sensors, any);
  v.duration(may("truth_period_ms", "of the plant's true state; 0 all, -1 none"), truth, any);
  v.duration(may("estimate_period_ms", "of the state estimate; 0 all, -1 none"), estimate, any);
  v.duration(may("plan_period_ms", "of what each plan reports; 0 all, -1 none"), plan, any);
  v.duration(may("command_period_ms", "of the drives' commands; 0 all, -1 none"), command, any);
}

Recorder::Recorder(RecorderOptions options) : options_(std::move(options)) {
  if (!options_.log_path.empty()) log_ = std::make_unique<EventLogWriter>(options_.log_path);
  tick_digests_.offset_ns.reserve(kMaxTicksPerMessage);
  tick_digests_.hash.reserve(kMaxTicksPerMessage * kChannelCount);
}

void Recorder::record(const Tick& tick) {
  beginTick(tick);
  toMessage(tick.sensors, tick.number, sensors_);
  takeAdded(AddedTo::kSensors, tick,
            take(Channel::kSensors, tick.time, options_.sensors, sensors_));
  if (tick.truth) {
    toMessage(*tick.truth, tick.number, truth_);
    takeAdded(AddedTo::kTruth, tick, take(Channel::kTruth, tick.time, options_.truth, truth_));
  }
  if (tick.control.has_estimate) {
    toMessage(tick.control.estimate, tick.number, estimate_);
    takeAdded(AddedTo::kEstimate, tick,
              take(Channel::kEstimate, tick.time, options_.estimate, estimate_));
  }
  if (tick.control.has_plan) {
    toMessage(tick.control.plan, tick.number, plan_);
    takeAdded(AddedTo::kPlan, tick, take(Channel::kPlan, tick.time, options_.plan, plan_));
  }
  toMessage(tick.control.command, tick.number, tick.time, command_);
  take(Channel::kCommand, tick.time, options_.command, command_);
  addHash(Channel::kStateDigest, tick.state_digest);
  digest_.add(static_cast<std::int64_t>(tick.state_digest));

  if (log_ && tick.time >= next_flush_) {
    log_->flush();
    next_flush_ = nextMultiple(tick.time, kFlushPeriod);
  }
}

template <typename Message>
bool Recorder::take(Channel channel, SimTime time, SimDuration period, const Message& message) {
  encodeMessage(message, bytes_);
  const Bytes& digested = digestForm<Message>(bytes_, digest_room_);
  digest_.add(digested.data(), digested.size());
  addHash(channel, hash64(digested.data(), digested.size()));
  if (!log_ || period.count() < 0) return false;
  if (period.count() > 0) {
    SimTime& next_due = next_due_[static_cast<std::size_t>(channel)];
    if (time < next_due) return false;
    next_due = nextMultiple(time, period);
  }
  log_->write(time, channelName(channel), bytes_);
  return true;
}

void Recorder::takeAdded(AddedTo frame, const Tick& tick, bool log) {
  const AddedSignals* added = tick.added[frame];
  if (added == nullptr || added->empty()) return;
  digest_.add(added->values.data(), added->values.size() * sizeof(double));
  if (!log) return;
  added_.tick = tick.number;
  added_.sim_time_ns = toNs(tick.time);
  for (const AddedSignal& signal : added->list) {
    if (named_[frame]) break;
    added_.name = signal.name;
    added_.unit = signal.unit;
    added_.words = signal.words;
    added_.value.clear();
    writeAdded(frame, tick.time);
  }
  named_[frame] = true;
  added_.name = added_.unit = added_.words = "";
  added_.value = added->values;
  writeAdded(frame, tick.time);
}

void Recorder::writeAdded(AddedTo frame, SimTime time) {
  added_.count = static_cast<std::int32_t>(added_.value.size());
  encodeMessage(added_, bytes_);
  log_->write(time, addedChannelName(frame), bytes_);
}

void Recorder::beginTick(const Tick& tick) {
  digest_.add(toNs(tick.time));
  if (!log_) return;
  const SimTime first = simTimeFromNs(tick_digests_.first_time_ns);
  if (tick_digests_.tick_count > 0 && (tick.time >= nextMultiple(first, kDigestPeriod) ||
                                       tick_digests_.tick_count == kMaxTicksPerMessage)) {
    writeDigests();
  }
  if (tick_digests_.tick_count == 0) {
    tick_digests_.first_tick = tick.number;
    tick_digests_.first_time_ns = toNs(tick.time);
  }
  tick_digests_.offset_ns.push_back(
      static_cast<std::int32_t>(toNs(tick.time) - tick_digests_.first_time_ns));
  tick_digests_.hash.resize(tick_digests_.hash.size() + kChannelCount, 0);
  ++tick_digests_.tick_count;
  last_time_ = tick.time;
}

void Recorder::addHash(Channel channel, std::uint64_t hash) {
  if (!log_) return;
  const std::size_t tick_begin = tick_digests_.hash.size() - kChannelCount;
  tick_digests_.hash[tick_begin + static_cast<std::size_t>(channel)] = shortHash(hash);
}

void Recorder::writeDigests() {
  tick_digests_.hash_count = static_cast<std::int32_t>(tick_digests_.hash.size());
  encodeMessage(tick_digests_, bytes_);
  log_->write(last_time_, kTickDigestsChannel, bytes_);
  tick_digests_.tick_count = 0;
  tick_digests_.offset_ns.clear();
  tick_digests_.hash.clear();
}

void Recorder::close() {
  if (!log_) return;
  if (tick_digests_.tick_count > 0) writeDigests();
  log_->close();
}

}  // namespace ballbot
