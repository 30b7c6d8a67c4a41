#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace ballbot {

/// How late a loop was, over millions of cycles in fixed memory: bins of 1 us up to 1 ms, of 100 us
/// up to 101 ms; later still counts into the last.
class JitterHistogram {
 public:
  void add(std::int64_t late_ns) noexcept {
    const std::int64_t ns = std::max<std::int64_t>(late_ns, 0);
    ++bins_[binOf(ns)];
    ++count_;
    max_ns_ = std::max(max_ns_, ns);
  }
  /// Counts what another one has counted, too.
  void add(const JitterHistogram& other) noexcept {
    for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
    count_ += other.count_;
    max_ns_ = std::max(max_ns_, other.max_ns_);
  }
  std::int64_t count() const noexcept { return count_; }
  std::int64_t max() const noexcept { return max_ns_; }

  /// Samples from `low_ns` on and below `high_ns`, both edges of bins.
  std::int64_t between(std::int64_t low_ns, std::int64_t high_ns) const noexcept {
    std::int64_t seen = 0;
    for (std::size_t i = binOf(low_ns); i < bins_.size() && edgeOf(i) <= high_ns; ++i) {
      seen += bins_[i];
    }
    return seen;
  }
  /// Where bins end: nothing is told apart beyond it [ns].
  static constexpr std::int64_t kEnd = 101'000'000;

  /// Upper edge of the bin that holds the given share of all samples [ns]; 0 without samples.
  /// @param share 0 to 1, e.g. 0.999
  std::int64_t percentile(double share) const noexcept {
    const auto wanted = static_cast<std::int64_t>(share * static_cast<double>(count_));
    std::int64_t seen = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      seen += bins_[i];
      if (seen > wanted || (seen == count_ && count_ > 0)) return std::min(edgeOf(i), max_ns_);
    }
    return 0;
  }

 private:
  static constexpr std::size_t kFine = 1000, kCoarse = 1000;
  static constexpr std::int64_t kFineNs = 1000, kCoarseNs = 100'000;

  static std::size_t binOf(std::int64_t ns) noexcept {
    const auto fine = static_cast<std::size_t>(ns / kFineNs);
    if (fine < kFine) return fine;
    const auto coarse = static_cast<std::size_t>((ns - kFineNs * kFine) / kCoarseNs);
    return kFine + std::min(coarse, kCoarse - 1);
  }
  static std::int64_t edgeOf(std::size_t bin) noexcept {
    const auto n = static_cast<std::int64_t>(bin) + 1;
    if (bin < kFine) return n * kFineNs;
    return static_cast<std::int64_t>(kFine) * kFineNs +
           (n - static_cast<std::int64_t>(kFine)) * kCoarseNs;
  }

  std::array<std::int64_t, kFine + kCoarse> bins_{};
  std::int64_t count_ = 0, max_ns_ = 0;
};

}  // namespace ballbot
