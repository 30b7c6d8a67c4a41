#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ballbot {

/// A named stream of random numbers addressed by sample index (counter-based: Philox 4x64-10,
/// Salmon et al., "Parallel Random Numbers: As Easy as 1, 2, 3", SC 2011). A draw depends on
/// (seed, name, index) alone, so a rollback repeats it and one more sensor changes no other.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  /// Four independent standard normal numbers of sample `index`; `block` numbers further fours.
  std::array<double, 4> normals(std::uint64_t index, std::uint64_t block = 0) const noexcept;
  /// Four independent numbers uniform on (0, 1).
  std::array<double, 4> uniforms(std::uint64_t index, std::uint64_t block = 0) const noexcept;

 private:
  std::array<std::uint64_t, 2> key_;
};

}  // namespace ballbot
