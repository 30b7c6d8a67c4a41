#include "hil/record/can_log_text.hpp"

#include <ctime>

#include <fmt/format.h>

namespace ballbot {
namespace {

constexpr std::int64_t kNsPerUs = 1000, kNsPerMs = 1'000'000, kNsPerS = 1'000'000'000;

/// "Thu Jan 01 00:00:00.000 1970", UTC: the same in every place and language.
std::string dateText(std::int64_t epoch_ns) {
  static constexpr const char* kDays[] = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  static constexpr const char* kMonths[] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                            "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const std::time_t seconds = epoch_ns / kNsPerS;
  std::tm t{};
  ::gmtime_r(&seconds, &t);
  return fmt::format("{} {} {:02} {:02}:{:02}:{:02}.{:03} {}", kDays[t.tm_wday], kMonths[t.tm_mon],
                     t.tm_mday, t.tm_hour, t.tm_min, t.tm_sec, epoch_ns % kNsPerS / kNsPerMs,
                     t.tm_year + 1900);
}

}  // namespace

std::string candumpLine(const RecordedFrame& r, std::int64_t epoch_offset_ns) {
  const CanFrame& f = r.frame;
  const std::int64_t us = (r.time_ns + epoch_offset_ns) / kNsPerUs;
  std::string line = fmt::format("({:010}.{:06}) can{} {:0{}X}#", us / 1'000'000, us % 1'000'000,
                                 r.bus, f.id, f.extended ? 8 : 3);
  if (f.remote) {
    line += f.size == 0 ? "R" : fmt::format("R{}", f.size);
  } else {
    for (std::size_t i = 0; i < f.size; ++i) line += fmt::format("{:02X}", f.data[i]);
  }
  return line + (r.sent ? " T\n" : " R\n");
}

std::string ascHeader(std::int64_t epoch_ns) {
  const std::string date = dateText(epoch_ns);
  return "date " + date +
         "\nbase hex  timestamps absolute\ninternal events logged\nBegin Triggerblock " + date +
         "\n   0.000000 Start of measurement\n";
}

std::string ascFooter() { return "End TriggerBlock\n"; }

std::string ascLine(const RecordedFrame& r, std::int64_t zero_ns) {
  const CanFrame& f = r.frame;
  const std::int64_t us = (r.time_ns - zero_ns) / kNsPerUs;
  std::string line =
      fmt::format("{:4}.{:06} {}  {:<15} {:<4} {} {:x}", us / 1'000'000, us % 1'000'000, r.bus + 1,
                  fmt::format("{:X}{}", f.id, f.extended ? "x" : ""), r.sent ? "Tx" : "Rx",
                  f.remote ? 'r' : 'd', f.size);
  for (std::size_t i = 0; i < f.size && !f.remote; ++i) line += fmt::format(" {:02X}", f.data[i]);
  return line + "\n";
}

}  // namespace ballbot
