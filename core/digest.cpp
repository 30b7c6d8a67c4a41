#include "core/digest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace ballbot {

struct Digest::State {
  State() : xxh(XXH3_createState()) { XXH3_128bits_reset(xxh); }
  State(const State& other) : xxh(XXH3_createState()) { XXH3_copyState(xxh, other.xxh); }
  State& operator=(const State&) = delete;
  ~State() { XXH3_freeState(xxh); }
  XXH3_state_t* xxh;
};

Digest::Digest() : state_(std::make_unique<State>()) {}
Digest::~Digest() = default;
Digest::Digest(const Digest& other) : state_(std::make_unique<State>(*other.state_)) {}
Digest& Digest::operator=(const Digest& other) {
  if (this != &other) state_ = std::make_unique<State>(*other.state_);
  return *this;
}

void Digest::add(const void* data, std::size_t size) noexcept {
  XXH3_128bits_update(state_->xxh, data, size);
}

std::string Digest::hex() const {
  const XXH128_hash_t h = XXH3_128bits_digest(state_->xxh);
  return fmt::format("{:016x}{:016x}", h.high64, h.low64);
}

std::uint64_t Digest::low64() const noexcept { return XXH3_128bits_digest(state_->xxh).low64; }

std::uint64_t hash64(const void* data, std::size_t size) noexcept {
  return XXH3_64bits(data, size);
}

}  // namespace ballbot
