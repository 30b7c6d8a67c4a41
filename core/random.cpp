#include "core/random.hpp"

#include <cmath>

#include <Random123/philox.h>
#include <xxhash.h>

namespace ballbot {

RandomStream::RandomStream(std::uint64_t seed, std::string_view name)
    : key_{seed, XXH3_64bits(name.data(), name.size())} {}

std::array<double, 4> RandomStream::uniforms(std::uint64_t index,
                                             std::uint64_t block) const noexcept {
  r123::Philox4x64 philox;
  const r123::Philox4x64::ctr_type counter = {{index, block, 0, 0}};
  const r123::Philox4x64::key_type key = {{key_[0], key_[1]}};
  const r123::Philox4x64::ctr_type bits = philox(counter, key);
  std::array<double, 4> out;
  // The top 53 bits, moved to the middle of their interval: never 0, never 1.
  for (std::size_t i = 0; i < 4; ++i) out[i] = (static_cast<double>(bits[i] >> 11) + 0.5) * 0x1p-53;
  return out;
}

std::array<double, 4> RandomStream::normals(std::uint64_t index,
                                            std::uint64_t block) const noexcept {
  const std::array<double, 4> u = uniforms(index, block);
  std::array<double, 4> out;
  for (std::size_t i = 0; i < 4; i += 2) {  // Box and Muller
    const double radius = std::sqrt(-2.0 * std::log(u[i]));
    const double angle = 6.283185307179586476925 * u[i + 1];
    out[i] = radius * std::cos(angle);
    out[i + 1] = radius * std::sin(angle);
  }
  return out;
}

}  // namespace ballbot
