#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace ballbot {

/// The last kCapacity values that were added. Free of allocation.
template <typename Value, int kCapacity>
class LastValues {
 public:
  void add(const Value& value) noexcept {
    values_[static_cast<std::size_t>(next_)] = value;
    next_ = (next_ + 1) % kCapacity;
    size_ = std::min(size_ + 1, kCapacity);
  }

  bool empty() const noexcept { return size_ == 0; }
  int size() const noexcept { return size_; }
  /// @param age  0 is the newest, size() - 1 the oldest
  const Value& fromNewest(int age) const noexcept { return values_[place(age)]; }
  Value& fromNewest(int age) noexcept { return values_[place(age)]; }

  /// From the oldest to the newest; where in the ring they stand is no part of the state.
  template <typename Self, typename Visitor>
  static void visitState(Self& self, Visitor& visit) {
    visit.countUpTo(kCapacity, self.size_);
    for (int age = self.size_ - 1; age >= 0; --age) visit(self.fromNewest(age));
  }

 private:
  std::size_t place(int age) const noexcept {
    return static_cast<std::size_t>((next_ + 2 * kCapacity - 1 - age) % kCapacity);
  }

  std::array<Value, kCapacity> values_;
  int next_ = 0;
  int size_ = 0;
};

}  // namespace ballbot
