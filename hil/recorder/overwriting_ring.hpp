#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ballbot {

/// The last so many values of a stream; what is older is overwritten. Memory comes from the
/// constructor and is touched there, so that push() neither allocates nor faults a page in. For one
/// thread; another may read once that one has ended.
template <typename T>
class OverwritingRing {
 public:
  /// @param capacity  at least 1 is made of it
  explicit OverwritingRing(std::size_t capacity) : slots_(std::max<std::size_t>(capacity, 1)) {}

  void push(const T& value) noexcept {
    slots_[next_] = value;
    next_ = next_ + 1 == slots_.size() ? 0 : next_ + 1;
    ++pushed_;
  }
  std::size_t capacity() const noexcept { return slots_.size(); }
  std::size_t size() const noexcept {
    return pushed_ < slots_.size() ? static_cast<std::size_t>(pushed_) : slots_.size();
  }
  bool empty() const noexcept { return pushed_ == 0; }
  /// Values pushed so far, those that are gone included.
  std::uint64_t pushed() const noexcept { return pushed_; }
  /// @param i  from 0, the oldest that is still there, to size() - 1
  const T& operator[](std::size_t i) const noexcept {
    const std::size_t begin = pushed_ < slots_.size() ? 0 : next_;
    const std::size_t at = begin + i;
    return slots_[at < slots_.size() ? at : at - slots_.size()];
  }

 private:
  std::vector<T> slots_;
  std::size_t next_ = 0;
  std::uint64_t pushed_ = 0;
};

}  // namespace ballbot
