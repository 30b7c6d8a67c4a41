#include "cosim/log_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

constexpr std::uint8_t kSync[] = {0xED, 0xA1, 0xDA, 0x01};
constexpr std::size_t kSyncBytes = sizeof kSync;
constexpr std::size_t kHeaderBytes = 28;
constexpr std::uint32_t kMaxChannelBytes = 63;  // LCM's limit
constexpr std::size_t kWindowBytes = std::size_t{1} << 18;

template <typename T>
T readBigEndian(const std::uint8_t* at) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) value = value << 8 | at[i];
  return static_cast<T>(value);
}

}  // namespace

struct LogReader::Header {
  std::int64_t number = 0, timestamp_us = 0;
  std::uint32_t channel_size = 0, data_size = 0;

  std::int64_t eventSize() const {
    return static_cast<std::int64_t>(kHeaderBytes) + channel_size + data_size;
  }
};

void LogDamage::add(std::int64_t byte, const std::string& what) {
  if (none() || byte < first_byte) {
    first_byte = byte;
    first = what;
  }
  ++places;
}

std::string LogDamage::text() const {
  std::string out = fmt::format("damaged at byte {}: {}", first_byte, first);
  if (places > 1) out += fmt::format("; {} places in all", places);
  if (lost_events > 0) out += fmt::format("; events lost: {}", lost_events);
  if (lost_bytes > 0) out += fmt::format("; bytes passed over: {}", lost_bytes);
  return out;
}

LogReader::LogReader(const std::string& path)
    : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat facts {};
  if (file_ < 0 || ::fstat(file_, &facts) != 0) {
    throw InputError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  }
  if (!S_ISREG(facts.st_mode)) {
    ::close(file_);
    throw InputError(fmt::format("{}: not a file, so it is no LCM event log", path));
  }
  size_ = facts.st_size;
}

LogReader::~LogReader() { ::close(file_); }

bool LogReader::next(LogEvent& out) {
  Header header;
  const std::int64_t expected_at = position_;
  if (position_ < size_ && !isEvent(position_, header)) skipToEvent();
  if (position_ >= size_ || !isEvent(position_, header)) return false;
  event_begin_ = position_;
  checkNumber(header.number, event_begin_ - expected_at);
  out.number = header.number;
  out.timestamp_us = header.timestamp_us;
  const auto body = event_begin_ + static_cast<std::int64_t>(kHeaderBytes);
  const std::uint8_t* bytes = bytesAt(body, header.channel_size + std::size_t{header.data_size});
  out.channel.assign(bytes, bytes + header.channel_size);
  out.data.assign(bytes + header.channel_size, bytes + header.channel_size + header.data_size);
  position_ = event_begin_ + header.eventSize();
  return true;
}

/// The bytes from `begin` on, which are in the file; valid until the next call.
const std::uint8_t* LogReader::bytesAt(std::int64_t begin, std::size_t size) {
  const auto window_end = window_begin_ + static_cast<std::int64_t>(window_.size());
  if (begin < window_begin_ || begin + static_cast<std::int64_t>(size) > window_end) {
    const auto rest = static_cast<std::size_t>(size_ - begin);
    window_.resize(std::min(rest, std::max(size, kWindowBytes)));
    window_begin_ = begin;
    for (std::size_t done = 0; done < window_.size();) {
      const ssize_t count = ::pread(file_, window_.data() + done, window_.size() - done,
                                    begin + static_cast<std::int64_t>(done));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        throw InputError(fmt::format(
            "{}: cannot be read at byte {}: {}", path_, begin + static_cast<std::int64_t>(done),
            count < 0 ? std::strerror(errno) : "it became shorter while it was read"));
      }
      done += static_cast<std::size_t>(count);
    }
  }
  return window_.data() + (begin - window_begin_);
}

/// How many bytes to look through from here on: those at hand, or a new window full.
std::size_t LogReader::readyFrom(std::int64_t begin) const {
  const auto window_end = window_begin_ + static_cast<std::int64_t>(window_.size());
  const bool at_hand =
      begin >= window_begin_ && begin + static_cast<std::int64_t>(kSyncBytes) <= window_end;
  if (at_hand) return static_cast<std::size_t>(window_end - begin);
  return std::min(static_cast<std::size_t>(size_ - begin), kWindowBytes);
}

/// Whether an event may begin here, as far as the file says.
bool LogReader::isSync(std::int64_t begin) {
  const auto size = static_cast<std::size_t>(
      std::min<std::int64_t>(size_ - begin, static_cast<std::int64_t>(kSyncBytes)));
  const auto window_end = window_begin_ + static_cast<std::int64_t>(window_.size());
  if (begin >= window_begin_ && begin + static_cast<std::int64_t>(size) <= window_end) {
    return std::memcmp(window_.data() + (begin - window_begin_), kSync, size) == 0;
  }
  // Far ahead, where a damaged length points: the window stays, or every look would fill it anew.
  std::uint8_t bytes[kSyncBytes];
  return ::pread(file_, bytes, size, begin) == static_cast<ssize_t>(size) &&
         std::memcmp(bytes, kSync, size) == 0;
}

/// Whether a whole event lies here: one with a sane header behind which another begins or the file
/// ends, or else with a message that proves itself by its checksum.
bool LogReader::isEvent(std::int64_t begin, Header& header) {
  if (size_ - begin < static_cast<std::int64_t>(kHeaderBytes)) return false;
  const std::uint8_t* bytes = bytesAt(begin, kHeaderBytes);
  if (std::memcmp(bytes, kSync, kSyncBytes) != 0) return false;
  header.number = readBigEndian<std::int64_t>(bytes + 4);
  header.timestamp_us = readBigEndian<std::int64_t>(bytes + 12);
  header.channel_size = readBigEndian<std::uint32_t>(bytes + 20);
  header.data_size = readBigEndian<std::uint32_t>(bytes + 24);
  if (header.channel_size > kMaxChannelBytes) return false;
  const std::int64_t end = begin + header.eventSize();
  if (end > size_) return false;
  if (end == size_ || isSync(end)) return true;
  if (header.data_size > kMaxMessageBytes) return false;
  return checksumHolds(bytesAt(end - header.data_size, header.data_size), header.data_size);
}

/// Whether the file ends within the event that begins here.
bool LogReader::endsWithin(std::int64_t begin) {
  if (!isSync(begin)) return false;
  Header header;
  return size_ - begin < static_cast<std::int64_t>(kHeaderBytes) ||
         (!isEvent(begin, header) && header.channel_size <= kMaxChannelBytes &&
          begin + header.eventSize() > size_);
}

/// From bytes that are no whole event to the next one, or to the end.
void LogReader::skipToEvent() {
  const std::int64_t begin = position_;
  Header header;
  while (++position_ < size_) {
    const std::size_t rest = readyFrom(position_);
    const std::uint8_t* bytes = bytesAt(position_, rest);
    const std::uint8_t* found = std::search(bytes, bytes + rest, kSync, kSync + kSyncBytes);
    position_ += found - bytes;
    if (found == bytes + rest) {
      // The sync word may lie across the end of what was looked at.
      if (position_ < size_) position_ -= static_cast<std::int64_t>(kSyncBytes);
    } else if (isEvent(position_, header)) {
      break;
    }
  }
  if (position_ >= size_ && endsWithin(begin)) {
    cut_off_ = true;
    return;
  }
  if (position_ >= size_ && begin == 0) {
    throw InputError(fmt::format("{}: not an LCM event log", path_));
  }
  damage_.add(begin, isSync(begin) ? "the event there has no sound end" : "no event begins there");
  damage_.lost_bytes += position_ - begin;
  if (position_ >= size_) ++damage_.lost_events;
}

/// Events are numbered from 0 on, so what is missing shows.
void LogReader::checkNumber(std::int64_t number, std::int64_t passed_over) {
  if (passed_over > 0) {
    // No more than fit into the bytes, whatever a damaged number says.
    const auto most = static_cast<std::uint64_t>(passed_over) / kHeaderBytes + 1;
    const auto missing =
        static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(next_number_);
    const std::uint64_t lost =
        number < next_number_ ? 1 : std::clamp<std::uint64_t>(missing, 1, most);
    damage_.lost_events += static_cast<std::int64_t>(lost);
  } else if (number != next_number_) {
    damage_.add(event_begin_,
                fmt::format("event {} stands where event {} is due", number, next_number_));
  }
  next_number_ = static_cast<std::int64_t>(static_cast<std::uint64_t>(number) + 1);
}

}  // namespace ballbot
