#include "cosim/disturbance.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace ballbot {
namespace {

std::chrono::microseconds share(std::chrono::microseconds whole, double part) {
  return std::chrono::microseconds{
      static_cast<std::int64_t>(part * static_cast<double>(whole.count()))};
}

}  // namespace

void DisturbanceOptions::check() const {
  const std::pair<const char*, double> probabilities[] = {
      {"loss", loss}, {"duplication", duplication}, {"reordering", reordering}};
  for (const auto& [name, value] : probabilities) {
    if (!(value >= 0 && value <= 1)) {
      throw InputError(fmt::format("{} is {}, must be between 0 and 1", name, value));
    }
  }
  const std::pair<const char*, std::chrono::microseconds> times[] = {
      {"reorder delay", reorder_delay}, {"delay", delay}, {"jitter", jitter}};
  for (const auto& [name, value] : times) {
    if (value.count() < 0) {
      throw InputError(fmt::format("{} is {} us, must not be negative", name, value.count()));
    }
  }
}

Disturbance::Disturbance(const DisturbanceOptions& options, const std::string& direction)
    : options_(options), random_(options.seed, "relay/" + direction) {
  options.check();
}

void Disturbance::decide(std::uint64_t index,
                         std::vector<std::chrono::microseconds>& copies) const {
  copies.clear();
  const std::array<double, 4> fate = random_.uniforms(index);
  if (fate[0] < options_.loss) return;
  const std::uint64_t count = fate[1] < options_.duplication ? 2 : 1;
  for (std::uint64_t copy = 0; copy < count; ++copy) {
    const std::array<double, 4> way = random_.uniforms(index, 1 + copy);
    std::chrono::microseconds after = options_.delay + share(options_.jitter, way[0]);
    if (way[1] < options_.reordering) after += options_.reorder_delay;
    copies.push_back(after);
  }
}

}  // namespace ballbot
