#include "report/base64.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace ballbot {

namespace {

std::uint32_t float32Bits(double value) {
  constexpr std::uint32_t kQuietNan = 0x7fc00000u;
  const auto single = static_cast<float>(value);
  if (!std::isfinite(single)) return kQuietNan;
  std::uint32_t bits = 0;
  std::memcpy(&bits, &single, sizeof bits);
  return bits;
}

}  // namespace

std::string base64Float32(const std::vector<double>& values) {
  static constexpr char kAlphabet[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  bytes.reserve(4 * values.size());
  for (const double value : values) {
    const std::uint32_t bits = float32Bits(value);
    for (int shift = 0; shift < 32; shift += 8) {
      bytes.push_back(static_cast<char>((bits >> shift) & 0xffu));
    }
  }
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    std::uint32_t triple = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      triple = triple << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text.push_back(k <= left ? kAlphabet[triple >> (18 - 6 * k) & 0x3fu] : '=');
    }
  }
  return text;
}

}  // namespace ballbot
