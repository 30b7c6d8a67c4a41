#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "hil/can_frame.hpp"

namespace ballbot {

/// How many bits of a frame went at each of the two rates.
struct BitStream {
  int slow = 0, fast = 0;
  double microseconds(double kbps, double data_kbps) const {
    return 1000.0 * slow / kbps + 1000.0 * fast / data_kbps;
  }
};

/// A CAN or CAN FD frame as its bits, made as ISO 11898-1 describes the sender: fields, CRC, stuff
/// bits. For tests of what the bench counts, and sharing nothing with it.
class BitEncoder {
 public:
  explicit BitEncoder(bool stuffing) : stuffing_(stuffing) {}

  BitStream encode(const CanFrame& f) {
    f.flexible ? encodeFlexible(f) : encodeClassic(f);
    return out_;
  }

 private:
  void put(std::uint32_t value, int bits) {
    for (int i = bits - 1; i >= 0; --i) bit(value >> i & 1U);
  }
  // Dynamic stuffing: after five equal bits, a sixth of the other kind, itself the first of a run.
  void bit(bool b) {
    raw_.push_back(b);
    count(b);
    if (!stuffing_ || run_ < 5) return;
    ++stuffed_;
    count(!b);
  }
  void count(bool b) {
    run_ = any_ && b == last_ ? run_ + 1 : 1;
    any_ = true;
    last_ = b;
    ++(is_fast_ ? out_.fast : out_.slow);
    checked_.push_back(b);
  }
  void plain(int bits) { (is_fast_ ? out_.fast : out_.slow) += bits; }

  static std::uint32_t crc(const std::vector<bool>& bits, int width, std::uint32_t polynomial,
                           std::uint32_t start) {
    const std::uint32_t mask = (1U << width) - 1;
    std::uint32_t r = start;
    for (const bool b : bits) {
      const bool top = (r >> (width - 1) & 1U) != 0;
      r = r << 1 & mask;
      if (top != b) r ^= polynomial;
    }
    return r;
  }

  void identifier(const CanFrame& f) {
    put(0, 1);  // start of frame
    if (f.extended) {
      put(f.id >> 18, 11);
      put(1, 1);  // SRR
      put(1, 1);  // IDE
      put(f.id & 0x3FFFF, 18);
    } else {
      put(f.id, 11);
    }
  }

  void encodeClassic(const CanFrame& f) {
    identifier(f);
    put(f.remote ? 1 : 0, 1);
    put(0, 2);  // IDE and r0, or r1 and r0
    put(f.size, 4);
    for (int i = 0; !f.remote && i < f.size; ++i) put(f.data[static_cast<std::size_t>(i)], 8);
    put(crc(raw_, 15, 0x4599, 0), 15);
    plain(1 + 1 + 1 + 7 +
          3);  // delimiter, acknowledgement and its delimiter, end, interframe space
  }

  void encodeFlexible(const CanFrame& f) {
    identifier(f);
    put(0, 1);                   // RRS
    if (!f.extended) put(0, 1);  // IDE
    put(1, 1);                   // FDF
    put(0, 1);                   // res
    put(f.fast ? 1 : 0, 1);      // BRS
    is_fast_ = f.fast;
    put(0, 1);  // ESI
    const std::array<int, 16> sizes{0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
    const auto code = std::find(sizes.begin(), sizes.end(), int{f.size}) - sizes.begin();
    put(static_cast<std::uint32_t>(code), 4);
    for (int i = 0; i < f.size; ++i) put(f.data[static_cast<std::size_t>(i)], 8);
    // Stuff count in Gray code with parity, and the CRC over all so far, stuff bits included; both
    // with fixed stuff bits, one before every four bits.
    std::vector<bool> checked = checked_;
    const int gray = (stuffed_ & 7) ^ (stuffed_ & 7) >> 1;
    std::vector<bool> field;
    for (int i = 2; i >= 0; --i) field.push_back((gray >> i & 1) != 0);
    field.push_back(((gray ^ gray >> 1 ^ gray >> 2) & 1) != 0);
    checked.insert(checked.end(), field.begin(), field.end());
    const int width = f.size <= 16 ? 17 : 21;
    const std::uint32_t sum =
        width == 17 ? crc(checked, 17, 0x1685B, 1U << 16) : crc(checked, 21, 0x102899, 1U << 20);
    for (int i = width - 1; i >= 0; --i) field.push_back((sum >> i & 1U) != 0);
    for (std::size_t i = 0; i < field.size(); ++i) plain(i % 4 == 0 ? 2 : 1);
    is_fast_ = false;
    plain(1 + 1 + 1 + 7 + 3);
  }

  bool stuffing_, is_fast_ = false, any_ = false, last_ = false;
  int run_ = 0, stuffed_ = 0;
  std::vector<bool> raw_, checked_;
  BitStream out_;
};

inline BitStream encodeBits(const CanFrame& frame, bool stuffing) {
  return BitEncoder(stuffing).encode(frame);
}

/// The largest number of stuff bits that a frame with an 11-bit identifier of this kind and size
/// can have, over all identifiers, data and (of a classic frame) checksums: the longest way through
/// the states (last bit, length of its run).
inline int mostStuffBits(const CanFrame& f) {
  // 0 and 1: fixed; 2: free to choose.
  std::vector<int> bits{0};
  bits.insert(bits.end(), 11, 2);
  if (f.flexible) {
    bits.insert(bits.end(), {0, 0, 1, 0, 1, 0});  // RRS IDE FDF res BRS ESI
  } else {
    bits.insert(bits.end(), {0, 0, 0});
  }
  const std::array<int, 16> sizes{0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
  const auto code = std::find(sizes.begin(), sizes.end(), int{f.size}) - sizes.begin();
  for (int i = 3; i >= 0; --i) bits.push_back(static_cast<int>(code >> i & 1));
  bits.insert(bits.end(), 8U * f.size + (f.flexible ? 0U : 15U), 2);
  constexpr int kNever = -1000;
  using States = std::array<std::array<int, 5>, 2>;  // best so far by last bit and run 0..4
  States best;
  for (auto& row : best) row.fill(kNever);
  bool first = true;
  for (const int b : bits) {
    States next;
    for (auto& row : next) row.fill(kNever);
    for (int value = 0; value < 2; ++value) {
      if (b != 2 && b != value) continue;
      const auto v = static_cast<std::size_t>(value);
      if (first) next[v][1] = 0;
      for (std::size_t last = 0; last < 2; ++last) {
        for (std::size_t run = 1; run < 5; ++run) {
          if (best[last][run] < 0) continue;
          const std::size_t length = last == v ? run + 1 : 1;
          int& slot = length == 5 ? next[1 - v][1] : next[v][length];
          slot = std::max(slot, best[last][run] + (length == 5 ? 1 : 0));
        }
      }
    }
    first = false;
    best = next;
  }
  int most = 0;
  for (const auto& row : best) most = std::max(most, *std::max_element(row.begin(), row.end()));
  return most;
}

}  // namespace ballbot
