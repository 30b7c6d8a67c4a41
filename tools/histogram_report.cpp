#include "tools/histogram_report.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace ballbot {
namespace {

// Where the rows of a printed histogram begin [us].
constexpr std::int64_t kRowsUs[] = {0,    10,   20,   50,    100,   200,   500,
                                    1000, 2000, 5000, 10000, 20000, 50000, 100000};
constexpr int kBarLength = 40;

}  // namespace

nlohmann::ordered_json histogramJson(const JitterHistogram& h) {
  nlohmann::ordered_json out;
  out["count"] = h.count();
  const std::pair<const char*, double> shares[] = {
      {"p50_us", 0.5}, {"p99_us", 0.99}, {"p999_us", 0.999}, {"max_us", 1.0}};
  for (const auto& [name, share] : shares) {
    out[name] = 1e-3 * static_cast<double>(h.percentile(share));
  }
  out["histogram"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < std::size(kRowsUs); ++i) {
    const bool last = i + 1 == std::size(kRowsUs);
    const std::int64_t end = last ? JitterHistogram::kEnd : 1000 * kRowsUs[i + 1];
    out["histogram"].push_back(
        {{"from_us", kRowsUs[i]}, {"count", h.between(1000 * kRowsUs[i], end)}});
  }
  return out;
}

std::string histogramText(const std::string& what, const nlohmann::ordered_json& late) {
  std::string out = fmt::format("{}: p50 {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max {:.0f} us\n", what,
                                late["p50_us"].get<double>(), late["p99_us"].get<double>(),
                                late["p999_us"].get<double>(), late["max_us"].get<double>());
  std::int64_t most = 1;
  for (const nlohmann::ordered_json& row : late["histogram"])
    most = std::max(most, row["count"].get<std::int64_t>());
  for (const nlohmann::ordered_json& row : late["histogram"]) {
    const auto count = row["count"].get<std::int64_t>();
    if (count == 0) continue;
    // One mark for the rare ones, too: they are what one looks for.
    const auto marks =
        static_cast<std::size_t>(std::max<std::int64_t>(1, kBarLength * count / most));
    out += fmt::format("  from {:>6} us {:>9}  {}\n", row["from_us"].get<std::int64_t>(), count,
                       std::string(marks, '#'));
  }
  return out;
}

std::string percentilesRow(const std::string& what, const nlohmann::ordered_json& late) {
  return fmt::format("{:<50} {:>9} {:>7.0f} {:>7.0f} {:>7.0f} {:>8.0f}\n", what,
                     late["count"].get<std::int64_t>(), late["p50_us"].get<double>(),
                     late["p99_us"].get<double>(), late["p999_us"].get<double>(),
                     late["max_us"].get<double>());
}

std::string percentilesHead(const std::string& what) {
  return fmt::format("{:<50} {:>9} {:>7} {:>7} {:>7} {:>8}\n", what, "times", "p50", "p99", "p99.9",
                     "max us");
}

}  // namespace ballbot
