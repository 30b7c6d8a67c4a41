#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace ballbot::testing_support {

/// Damages bytes as accidents and attackers do: flipped bits, numbers at the edges of their range,
/// parts cut, doubled, moved and made up. The same seed does the same, so that what a run of a test
/// finds comes again.
class Mutator {
 public:
  using Bytes = std::vector<std::uint8_t>;

  explicit Mutator(std::uint64_t seed) : state_(seed * 2 + 1) {}

  /// A number from 0 to `bound` - 1; 0 if `bound` is 0.
  std::size_t below(std::size_t bound) {
    // xorshift64*, 2003 and 2014: any generator will do that is the same on every machine.
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    const std::uint64_t drawn = (state_ * 2685821657736338717ULL) >> 11;
    return bound == 0 ? 0 : static_cast<std::size_t>(drawn % bound);
  }

  /// One to four changes; what comes out has at most `longest` bytes.
  void mutate(Bytes& bytes, std::size_t longest) {
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(bytes);
    if (bytes.size() > longest) bytes.resize(longest);
  }

 private:
  void change(Bytes& bytes) {
    const std::size_t at = below(bytes.size() + 1);
    switch (below(7)) {
      case 0:
        return flipBit(bytes, at);
      case 1:
        return putEdge(bytes, at);
      case 2:
        bytes.resize(at);  // cut off
        return;
      case 3:
        return insertSome(bytes, at);
      case 4:
        return removeSome(bytes, at);
      case 5:
        return doubleSome(bytes, at);
      default:
        if (at < bytes.size()) bytes[at] = static_cast<std::uint8_t>(below(256));
    }
  }

  void flipBit(Bytes& bytes, std::size_t at) {
    if (at == bytes.size()) return;
    bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << below(8)));
  }

  // A number of 1, 2, 4 or 8 bytes, in either byte order, that arithmetic likes least.
  void putEdge(Bytes& bytes, std::size_t at) {
    constexpr std::uint64_t kEdges[] = {0,
                                        1,
                                        0x7F,
                                        0x80,
                                        0xFF,
                                        0x7FFF,
                                        0x8000,
                                        0xFFFF,
                                        0x7FFFFFFF,
                                        0x80000000,
                                        0xFFFFFFFF,
                                        2'000'000,
                                        0xFFFFFFF0,
                                        0x7FF0000000000000 /* inf */,
                                        0x7FF8000000000000,
                                        0x7FE1CCF385EBC8A0 /* 1e308 */,
                                        0x7FFFFFFFFFFFFFFF,
                                        0x8000000000000000,
                                        0xFFFFFFFFFFFFFFFF,
                                        1'000'000'000'000'000'000};
    const std::uint64_t edge = kEdges[below(std::size(kEdges))];
    const std::size_t width = std::size_t{1} << below(4);
    const bool big_endian = below(2) == 0;
    for (std::size_t i = 0; i < width && at + i < bytes.size(); ++i) {
      bytes[at + i] = static_cast<std::uint8_t>(edge >> 8 * (big_endian ? width - 1 - i : i));
    }
  }

  void insertSome(Bytes& bytes, std::size_t at) {
    const auto filler = static_cast<std::uint8_t>(below(3) == 0 ? 0 : below(256));
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), 1 + below(32), filler);
  }

  void removeSome(Bytes& bytes, std::size_t at) {
    const std::size_t count = std::min(1 + below(32), bytes.size() - at);
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    bytes.erase(from, from + static_cast<std::ptrdiff_t>(count));
  }

  void doubleSome(Bytes& bytes, std::size_t at) {
    const std::size_t count = std::min(1 + below(64), bytes.size() - at);
    const Bytes part(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                     bytes.begin() + static_cast<std::ptrdiff_t>(at + count));
    const std::size_t to = below(bytes.size() + 1);
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(to), part.begin(), part.end());
  }

  std::uint64_t state_;
};

}  // namespace ballbot::testing_support
