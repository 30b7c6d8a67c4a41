#include "tools/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace ballbot {
namespace {

constexpr int kBarWidth = 30;
constexpr auto kRedrawPeriod = std::chrono::milliseconds(50);

std::string remaining(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s left", std::max(1.0, seconds));
  if (seconds < 3600)
    return fmt::format("{:.0f} min {:02.0f} s left", std::floor(seconds / 60),
                       std::fmod(seconds, 60));
  return fmt::format("{:.1f} h left", seconds / 3600);
}

}  // namespace

Progress::Progress(std::string label, bool silent)
    : label_(std::move(label)),
      silent_(silent),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      last_draw_(start_ - std::chrono::seconds(1)) {}

Progress::~Progress() { finish(); }

void Progress::update(double fraction, const std::string& note) {
  if (silent_) return;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const auto now = std::chrono::steady_clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string left =
      fraction > 0.01 && fraction < 1 ? remaining(elapsed * (1 - fraction) / fraction) : "";
  if (terminal_) {
    if (now - last_draw_ < kRedrawPeriod && fraction < 1) return;
    last_draw_ = now;
    const int filled = static_cast<int>(fraction * kBarWidth);
    std::string bar;
    for (int i = 0; i < kBarWidth; ++i) bar += i < filled ? "█" : "░";
    fmt::print(stderr, "\r\033[K{} {} {:3.0f} %  {}  {}", label_, bar, 100 * fraction, note, left);
    std::fflush(stderr);
    open_line_ = true;
  } else if (const int tenth = static_cast<int>(fraction * 10); tenth > last_tenth_) {
    last_tenth_ = tenth;
    fmt::print(stderr, "{} {:3d} %  {}  {}\n", label_, 10 * tenth, note, left);
  }
}

void Progress::finish() {
  if (open_line_) fmt::print(stderr, "\n");
  open_line_ = false;
}

}  // namespace ballbot
