#include "cosim/log_reader.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr std::uint32_t kSyncWord = 0xEDA1DA01;
constexpr std::size_t kHeaderBytes = 28;
constexpr std::uint32_t kMaxChannelBytes = 63;  // LCM's limit
constexpr std::uint32_t kMaxDataBytes = 1U << 26;

template <typename T>
T readBigEndian(const std::uint8_t* at) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) value = value << 8 | at[i];
  return static_cast<T>(value);
}

template <typename Message>
void keep(const LogEvent& event, std::vector<Message>& list, std::int64_t& unknown) {
  Message message{};
  if (event.decode(message)) {
    list.push_back(std::move(message));
  } else {
    ++unknown;
  }
}

}  // namespace

LogReader::LogReader(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw InputError(fmt::format("{}: cannot be opened", path));
}

bool LogReader::next(LogEvent& out) {
  std::uint8_t header[kHeaderBytes];
  event_begin_ = position_;
  if (!take(header, sizeof header)) return false;
  const auto channel_size = readBigEndian<std::uint32_t>(header + 20);
  const auto data_size = readBigEndian<std::uint32_t>(header + 24);
  if (readBigEndian<std::uint32_t>(header) != kSyncWord || channel_size > kMaxChannelBytes ||
      data_size > kMaxDataBytes) {
    throw InputError(
        event_begin_ == 0
            ? fmt::format("{}: not an LCM event log", path_)
            : fmt::format("{}: damaged at byte {}: no event begins there", path_, event_begin_));
  }
  out.number = readBigEndian<std::int64_t>(header + 4);
  out.timestamp_us = readBigEndian<std::int64_t>(header + 12);
  out.channel.resize(channel_size);
  out.data.resize(data_size);
  return take(out.channel.data(), channel_size) && take(out.data.data(), data_size);
}

// False at the end of the file, with cut_off_ set if some of the bytes were there.
bool LogReader::take(void* to, std::size_t size) {
  file_.read(static_cast<char*>(to), static_cast<std::streamsize>(size));
  const std::streamsize count = file_.gcount();
  const bool within_event = position_ > event_begin_;
  position_ += count;
  if (count == static_cast<std::streamsize>(size)) return true;
  cut_off_ = count > 0 || within_event;
  return false;
}

RunLog readRunLog(const std::string& path) {
  RunLog log;
  LogReader reader(path);
  LogEvent event;
  while (reader.next(event)) {
    if (event.channel == channelName(Channel::kSensors)) {
      keep(event, log.sensors, log.unknown);
    } else if (event.channel == channelName(Channel::kTruth)) {
      keep(event, log.truth, log.unknown);
    } else if (event.channel == channelName(Channel::kEstimate)) {
      keep(event, log.estimates, log.unknown);
    } else if (event.channel == channelName(Channel::kPlan)) {
      keep(event, log.plans, log.unknown);
    } else if (event.channel == channelName(Channel::kCommand)) {
      keep(event, log.commands, log.unknown);
    } else if (event.channel == kTickDigestsChannel) {
      keep(event, log.digests, log.unknown);
    } else {
      ++log.unknown;
    }
  }
  log.cut_off = reader.cutOff();
  return log;
}

}  // namespace ballbot
