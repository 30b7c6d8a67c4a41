#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace ballbot {

/// Running 128-bit hash (XXH3). Equal byte sequences give equal digests whatever the cuts between
/// calls of add(); it guards against accidents, not against an adversary.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(const Digest&);
  Digest& operator=(const Digest&);

  void add(const void* data, std::size_t size) noexcept;
  void add(const std::string& text) noexcept { add(text.data(), text.size()); }
  void add(std::int64_t value) noexcept { add(&value, sizeof value); }

  /// Digest of what was added so far, as 32 hexadecimal digits.
  std::string hex() const;
  /// The low 64 bits of the same.
  std::uint64_t low64() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// 64-bit hash of one block of bytes.
std::uint64_t hash64(const void* data, std::size_t size) noexcept;

}  // namespace ballbot
